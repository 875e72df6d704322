// The needle's path: joints, arcs, links of both parts.
#include "core/winding/path/needle_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/winding/laying/needle.hpp"
#include "core/winding/part/vec3.hpp"
#include "tests/core/geometry/spline/spline_support.hpp"
#include "tests/core/winding/path/needle_pieces.hpp"

namespace bahnwerk::winding {
namespace {

std::vector<BezierPiece> curves(const NeedlePath& path) {
  std::vector<BezierPiece> all;
  for (const NeedlePiece& piece : path.pieces) all.push_back(piece.curve);
  return all;
}

NeedlePath planned(const std::vector<FixedPiece>& pieces, bool stator, std::size_t k = 3,
                   LinkObjective objective = LinkObjective::curvature) {
  LinkOptions options;
  options.continuity = k;
  options.objective = objective;
  Progress progress;
  return *needle_path(pieces, stator, options, progress);
}

TEST(NeedlePath, JoinsWithTheContinuityAskedFor) {
  for (const bool stator : {true, false})
    for (std::size_t k = 1; k <= 4; ++k) {
      const NeedlePath path = planned(stator ? stator_pieces(3) : rotor_pieces(3), stator, k);
      const std::vector<BezierPiece> all = curves(path);
      for (std::size_t order = 0; order <= k; ++order)
        EXPECT_LE(worst_jump(all, order), 1e-8) << stator << " k " << k << " order " << order;
    }
}

TEST(NeedlePath, TwoHundredTurnsAreSmoothToTheThirdDerivative) {
  for (const bool stator : {true, false}) {
    const std::vector<FixedPiece> pieces = stator ? stator_pieces(50, 4) : rotor_pieces(50, 4);
    const NeedlePath path = planned(pieces, stator);
    const std::vector<BezierPiece> all = curves(path);
    for (std::size_t order = 0; order <= 3; ++order) EXPECT_LE(worst_jump(all, order), 1e-8) << stator << order;
    // One NURBS of all says the same as the pieces.
    const NurbsPath united = path.united();
    EXPECT_EQ(united.end(), static_cast<double>(all.size()));
    for (std::size_t i = 0; i < all.size(); i += 7)
      for (const double v : {0.0, 0.3, 0.8})
        EXPECT_LE(testing::distance(united.at(static_cast<double>(i) + v)[0], all[i].at(v)[0]), 1e-9);
  }
}

TEST(NeedlePath, GoesThroughEverySupportPoint) {
  for (const bool stator : {true, false}) {
    const std::vector<FixedPiece> pieces = stator ? stator_pieces(4, 2) : rotor_pieces(4, 2);
    const NeedlePath path = planned(pieces, stator);
    std::size_t checked = 0;
    for (std::size_t i = 0; i < path.pieces.size(); ++i) {
      const NeedlePiece& piece = path.pieces[i];
      if (piece.link) continue;
      const auto at = [&](const NeedlePose& pose, double v) {
        const SplinePoint p = piece.curve.at(v)[0];
        return std::hypot(norm(Vec3{p[0], p[1], p[2]} - pose.tip), p[3] - pose.phi, p[4] - pose.psi);
      };
      const bool first = i == 0 || path.pieces[i - 1].link,
                 last = i + 1 == path.pieces.size() || path.pieces[i + 1].link;
      if (first) {
        EXPECT_LE(at(pieces[piece.fixed].begin.pose, 0), 1e-12);
      }
      if (last) {
        EXPECT_LE(at(pieces[piece.fixed].end.pose, 1), 1e-9);
      }
      checked += first + last;
    }
    EXPECT_EQ(checked, 2 * pieces.size());
  }
}

TEST(NeedlePath, ArcsAreCircles) {
  const std::vector<FixedPiece> pieces = stator_pieces(3, 2);
  const NeedlePath path = planned(pieces, true);
  std::size_t arcs = 0;
  for (const NeedlePiece& piece : path.pieces) {
    if (piece.link || pieces[piece.fixed].shape != FixedPiece::Shape::arc) continue;
    const Vec3 tip = pieces[piece.fixed].begin.pose.tip;
    ++arcs;
    for (int i = 0; i <= 20; ++i) {
      const SplinePoint p = piece.curve.at(i / 20.0)[0];
      EXPECT_NEAR(std::hypot(p[0], p[1]), std::hypot(tip.x, tip.y), 1e-12 * 100);
      EXPECT_NEAR(p[2], tip.z, 1e-12 * 100);
    }
  }
  EXPECT_GE(arcs, 6 * 2u);
}

/// A needle that has swivelled stays so up to the slot: it does not swing beyond the angles of both ends.
TEST(NeedlePath, SwivelsOnceBetweenSlotAndHead) {
  const std::vector<FixedPiece> pieces = stator_pieces(2);
  for (const NeedlePiece& piece : planned(pieces, true).pieces)
    for (int i = 0; i <= 50; ++i) EXPECT_LE(std::abs(piece.curve.at(i / 50.0)[0][4]), std::numbers::pi / 2 + 1e-9);
}

TEST(NeedlePath, TheSmoothestLinkIsSmootherThanTheSubstitute) {
  for (const bool stator : {true, false}) {
    const std::vector<FixedPiece> pieces = stator ? stator_pieces(2) : rotor_pieces(2);
    const NeedlePath smooth = planned(pieces, stator),
                     substitute = planned(pieces, stator, 3, LinkObjective::control_distance);
    double sum = 0, other = 0;
    for (const NeedleLink& link : smooth.links) sum += link.best.smoothness;
    for (const NeedleLink& link : substitute.links) other += link.best.smoothness;
    EXPECT_LT(sum, other) << stator;
    EXPECT_EQ(smooth.links.size(), substitute.links.size());
  }
}

TEST(NeedlePath, OneLinkAtEveryJointIsPassedEvenly) {
  const NeedlePath path = planned(stator_pieces(2), true);
  double sum = 0;
  for (const NeedlePiece& piece : path.pieces) {
    if (piece.link) {
      sum += piece.share;
      continue;
    }
    EXPECT_EQ(piece.share, 0);
    EXPECT_TRUE(sum == 0 || sum == 1) << sum;
    sum = 0;
  }
}

TEST(NeedlePath, RefusesWhatIsNoPath) {
  std::vector<FixedPiece> pieces = rotor_pieces(1);
  Progress progress;
  LinkOptions options;
  options.continuity = 5;
  EXPECT_THROW(needle_path(pieces, false, options, progress), InvalidInput);
  options = {};
  options.extra_point = 1.5;
  EXPECT_THROW(needle_path(pieces, true, options, progress), InvalidInput);
  pieces[1].begin = pieces[0].end;
  EXPECT_EQ(needle_path(pieces, false, {}, progress).reason().reason, NoPath::Reason::no_room);
  pieces = rotor_pieces(1);
  pieces[1].end = pieces[1].begin;
  EXPECT_EQ(needle_path(pieces, false, {}, progress).reason().reason, NoPath::Reason::no_length);
  EXPECT_TRUE(needle_path({}, false, {}, progress)->pieces.empty());
}

/// Whether the ends of one link are those of the other turned about the part's axis, or mirrored by a plane through it.
bool congruent(const LinkEnds& a, const LinkEnds& b) {
  for (const double hand : {1.0, -1.0}) {
    const double turn = std::atan2(b.before[0][1], b.before[0][0]) - hand * std::atan2(a.before[0][1], a.before[0][0]);
    const auto off = [&](const SplineJet& x, const SplineJet& y) {
      double worst = 0;
      for (std::size_t j = 0; j <= 3; ++j) {
        const double c = std::cos(turn), s = std::sin(turn), u = x[j][0], v = hand * x[j][1];
        worst = std::max(
            {worst, std::abs(c * u - s * v - y[j][0]), std::abs(s * u + c * v - y[j][1]), std::abs(x[j][2] - y[j][2])});
      }
      return worst;
    };
    if (std::max(off(a.before, b.before), off(a.after, b.after)) < 1e-7) return true;
  }
  return false;
}

/// Links at the same place of a turn whose shapes are equal to the last bit, and those of them whose ends are
/// congruent.
std::pair<std::size_t, std::size_t> equal_links_of_coils(const std::vector<FixedPiece>& pieces) {
  const NeedlePath path = planned(pieces, false);
  const auto place_of = [&](const NeedleLink& link) {
    return std::tuple(pieces[link.from].kind, pieces[link.from].region, pieces[link.from + 1].kind);
  };
  std::size_t equal = 0, congruent_ones = 0;
  for (std::size_t i = 0; i < path.links.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const NeedleLink &known = path.links[j], &link = path.links[i];
      if (place_of(known) != place_of(link)) continue;
      const bool same =
          known.best.shape.before == link.best.shape.before && known.best.shape.after == link.best.shape.after;
      const bool alike = congruent(known.ends, link.ends);
      if (alike) {
        EXPECT_TRUE(same) << i << ' ' << j;
      }
      if (pieces[known.from].coil != pieces[link.from].coil) equal += same, congruent_ones += alike;
    }
  return {equal, congruent_ones};
}

TEST(NeedlePath, CongruentLinksOfRepeatedCoilsAreTheSame) {
  constexpr std::size_t turns = 4, coils = 3;
  const auto [equal, congruent_ones] = equal_links_of_coils(rotor_pieces(turns, coils));
  EXPECT_EQ(equal, congruent_ones);
  EXPECT_GE(equal, turns);
}

// Each end, and each derivative there, counts: a nanometre is enough for a link of its own.
TEST(NeedlePath, LinksOfCoilsThatAreAlmostCongruentAreNotTheSame) {
  auto pieces = rotor_pieces(2, 2);
  for (FixedPiece& piece : pieces)
    if (piece.coil == 1) piece.end.pose.tip.z += 1e-6;
  EXPECT_EQ(equal_links_of_coils(pieces).first, 0u);
}

}  // namespace
}  // namespace bahnwerk::winding
