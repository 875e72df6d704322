#include "core/winding/needle/clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/geometry/spline/spline_arc.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/part/vec3.hpp"
#include "tests/core/winding/needle/quiet_support.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;
Progress silent;

NeedleMove still(Vec3 tip, double phi, double psi = 0) { return {{tip, phi, psi}, {tip, phi, psi}}; }

TEST(Clearance, IsHalfOfThePlayInTheMiddleOfTheOpening) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  for (const double width : {0.5, 2.6, 3.083, 4.0}) {
    // Through the whole slot: 3.083 mm less the needle (Fig. 4.16 with 2.6 mm: 0.24 mm to either side).
    NeedleMove down = still({85, 0, 205}, 0);
    down.to.tip.z = 5;
    const Clearance c = clearance({down}, {width, 60}, {&iron}, 1e-6, silent);
    EXPECT_NEAR(c.minimum, (3.083 - width) / 2, 1e-6) << width;
    EXPECT_NEAR(85 - c.along, 95.7 - 16.429, 0.01) << "between the tooth tips";
  }
}

TEST(Clearance, IsFoundBetweenTheEndsOfAMove) {
  const Block post(0, {.inner = 10, .outer = 12, .left = -1, .right = 1, .low = 0, .high = 20});
  // Past the post at 3 mm, with the needle along the axis; nearest in the middle of the move.
  NeedleMove past = still({15, -40, 10}, 0, -pi / 2);
  past.to.tip.y = 41;
  const Clearance c = clearance({still({60, 0, 0}, 0), past}, {2, 30}, {&post}, 1e-4, silent);
  EXPECT_NEAR(c.minimum, 2, 1.1e-4);
  EXPECT_EQ(c.move, 1u);
  // A round end: over the post's corner at (3, 0, 4) from its centre.
  const Clearance over = clearance({still({15, 0, 23}, 0, pi / 2)}, {2, 30}, {&post}, 1e-6, silent);
  EXPECT_NEAR(over.minimum, 5 - 1, 1.1e-6);
  EXPECT_NEAR(over.along, 1, 1e-6);
  // An arc about the axis at 15 mm, seen from the post's corner (12, 1).
  NeedleMove round = still({0, -15, 10}, -pi / 2, -pi / 2);
  round.arc = true;
  round.sweep = pi;
  round.to.phi = pi / 2;
  EXPECT_NEAR(clearance({round}, {2, 30}, {&post}, 1e-6, silent).minimum, 15 - std::hypot(12, 1) - 1, 1.1e-6);
  EXPECT_NEAR(norm(round.at(0.5).tip - Vec3{15, 0, 10}), 0, 1e-12);
}

// Against dense samples, for moves in, through and out of slots with swivelling needles.
TEST(Clearance, IsTheLeastOfADenseSample) {
  Random random(11);
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  const std::vector<Block> posts = tool_posts(part, {}, {0, 5});
  std::vector<const Obstacle*> obstacles{&iron};
  for (const Block& b : posts) obstacles.push_back(&b);
  int touching = 0;
  for (int round = 0; round < 40; ++round) {
    NeedleMove move;
    for (NeedlePose* p : {&move.from, &move.to}) {
      p->tip = random.uniform(60, 104) * radial(random.uniform(-0.02, 0.02)) + Vec3{0, 0, random.uniform(-30, 40)};
      p->phi = random.uniform(-0.1, 0.1);
      p->psi = random.uniform(-pi / 2, 0);
    }
    const NeedleShape needle{random.uniform(0.2, 3), random.uniform(10, 40)};
    const double tolerance = 0.01;
    const Clearance c = clearance({move}, needle, obstacles, tolerance, silent);
    double least = std::numeric_limits<double>::infinity();
    const int n = 100;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const NeedlePose pose = move.at(i / double(n));
        const double s = needle.width / 2 + j / double(n) * (needle.length - needle.width / 2);
        for (const Obstacle* o : obstacles)
          least = std::min(least, o->distance(pose.tip - s * pose.direction()) - needle.width / 2);
      }
    EXPECT_GE(least, c.minimum - tolerance) << round;
    const NeedlePose where = move.at(c.at);
    EXPECT_NEAR(obstacles.at(c.obstacle)->distance(where.tip - c.along * where.direction()) - needle.width / 2,
                c.minimum, 1e-12)
        << "reached where it is reported";
    touching += c.minimum < 0;
  }
  EXPECT_GT(touching, 5);
  EXPECT_LT(touching, 40);
}

// What the pivot shift is for: beside the slot's middle a needle that swivels about the opening keeps its distance.
TEST(Clearance, PivotShiftOpensTheSlotsSides) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  const Vec3 pivot{95.7 - 16.429, 0, 0}, along{0, 0, -1};
  int better = 0;
  for (const double depth : {8.0, 10.0, 12.0})
    for (const double x : {-1.2, -0.6, 0.6, 1.2}) {
      const Vec3 place{79.3 + depth, x, 100};
      const auto with = [&](std::optional<double> limit) {
        const NeedlePose pose = slot_support(place, along, 2, 1, pivot, limit)->pose;
        return clearance({still(pose.tip, pose.phi)}, {2.6, 60}, {&iron}, 1e-6, silent).minimum;
      };
      const double straight = with(std::nullopt), shifted = with(0.3);
      EXPECT_GT(shifted, straight);
      better += straight < 0 && shifted > 0;
      EXPECT_NEAR(straight, with(0.0), 1e-9) << "no shift allowed";
    }
  EXPECT_GT(better, 5) << "places that only the shift makes accessible";
}

/// The fixed pieces with straight moves between them, on which tip and angles are linear, too.
std::vector<NeedleMove> straight_links(const std::vector<FixedPiece>& pieces) {
  std::vector<NeedleMove> moves;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (i > 0) moves.push_back({pieces[i - 1].end.pose, pieces[i].begin.pose});
    moves.push_back(
        {pieces[i].begin.pose, pieces[i].end.pose, pieces[i].shape == FixedPiece::Shape::arc, pieces[i].sweep});
  }
  return moves;
}

TEST(Clearance, AsksProgressAndStopsForAWholeCoil) {
  const StatorPart part;
  const Slot slot = checked_slot(part);
  const std::vector<Coil> coils{{0, 5}};
  const LayingRegions regions = coil_regions(part, slot, coils[0]);
  const NeedleLayout layouts = needle(regions, 0.45, slot.tension_point, silent);
  const auto pieces =
      support_points(part, coils, turns_of({regions}, layouts, layouts[0].wires.size(), 0.45), NeedleModel{});
  const StatorIron iron(part, slot);
  struct Counting final : ProgressSink {
    void report(std::string_view, double, std::string_view) override { ++calls; }
    int calls = 0;
  } counting;
  std::vector<NeedleMove> moves = straight_links(pieces);
  EXPECT_EQ(moves.size(), 2 * pieces.size() - 1);
  const Clearance c = clearance(moves, {2.6, 60}, {&iron}, 0.01, counting);
  EXPECT_GT(counting.calls, 0);
  EXPECT_LT(counting.calls, 2000) << "two million looks at 0.2 µs";
  EXPECT_LT(c.minimum, (3.083 - 2.6) / 2 + 0.01);
}

SplinePoint pose_point(const NeedlePose& p) { return {p.tip.x, p.tip.y, p.tip.z, p.phi, p.psi}; }

// Lines and arcs as rational pieces: the same as moves.
TEST(Clearance, IsEqualForPiecesAndMovesOnLinesAndArcs) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  const std::vector<Block> posts = tool_posts(part, {}, {0, 5});
  std::vector<const Obstacle*> obstacles{&iron};
  for (const Block& b : posts) obstacles.push_back(&b);
  Random random(4);
  for (int round = 0; round < 30; ++round) {
    const double height = random.uniform(218, 240), begin = random.uniform(-0.2, 0.2), sweep = random.uniform(0.1, 0.7),
                 radius = random.uniform(96, 108);
    NeedleMove arc{{radius * radial(begin) + Vec3{0, 0, height}, begin, pi / 2}, {}, true, sweep};
    arc.to = arc.from;
    arc.to.phi += sweep;
    NeedleMove line{{random.uniform(70, 90) * radial(random.uniform(-0.02, 0.02)), 0, 0}, {}, false, 0};
    line.from.tip.z = random.uniform(-20, 50), line.from.phi = random.uniform(-0.1, 0.1);
    line.to = {line.from.tip + Vec3{random.uniform(-3, 3), random.uniform(-1, 1), 60}, random.uniform(-0.1, 0.1), 0.3};
    std::vector<BezierPiece> round_arc =
        spline_arc(pose_point(arc.from), {0, 0, height}, {0, 0, 1}, sweep, {0, 0, 0, sweep, 0}, 4);
    const std::vector<BezierPiece> straight{BezierPiece::line(pose_point(line.from), pose_point(line.to))};
    const NeedleShape needle{2.6, 50};
    EXPECT_NEAR(clearance(round_arc, needle, obstacles, 1e-4, silent).minimum,
                clearance({arc}, needle, obstacles, 1e-4, silent).minimum, 1e-4);
    EXPECT_NEAR(clearance(straight, needle, obstacles, 1e-2, silent).minimum,
                clearance({line}, needle, obstacles, 1e-2, silent).minimum, 1e-2);
  }
}

// Against dense samples of pieces of all degrees with weights far from each other.
TEST(Clearance, EqualsTheMinimumOfADenseSampleOfRationalPieces) {
  Random random(12);
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  const std::vector<Block> posts = tool_posts(part, {}, {0, 5});
  std::vector<const Obstacle*> obstacles{&iron};
  for (const Block& b : posts) obstacles.push_back(&b);
  int touching = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<BezierPiece> pieces;
    const std::size_t degree = 1 + static_cast<std::size_t>(round) % 9;
    std::vector<HomogeneousPoint> points;
    for (std::size_t i = 0; i <= degree; ++i) {
      // One draw after the other: in which order arguments are evaluated is the compiler's choice.
      const double from_axis = random.uniform(60, 104), azimuth = random.uniform(-0.02, 0.02);
      const Vec3 tip = from_axis * radial(azimuth);
      const SplinePoint pose{tip.x, tip.y, random.uniform(-60, 10), random.uniform(-0.1, 0.1),
                             random.uniform(-pi / 2, 0)};
      points.push_back(homogeneous(pose, std::exp(random.uniform(-2, 2))));
    }
    pieces.emplace_back(points);
    const NeedleShape needle{random.uniform(0.2, 3), random.uniform(10, 40)};
    const double tolerance = 0.01;
    const Clearance c = clearance(pieces, needle, obstacles, tolerance, silent);
    const auto at = [&](double v) {
      const SplinePoint p = pieces[0].at(v)[0];
      return NeedlePose{{p[0], p[1], p[2]}, p[3], p[4]};
    };
    double least = std::numeric_limits<double>::infinity();
    const int n = 150;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const NeedlePose pose = at(i / double(n));
        const double s = needle.width / 2 + j / double(n) * (needle.length - needle.width / 2);
        for (const Obstacle* o : obstacles)
          least = std::min(least, o->distance(pose.tip - s * pose.direction()) - needle.width / 2);
      }
    EXPECT_GE(least, c.minimum - tolerance) << round;
    const NeedlePose where = at(c.at);
    EXPECT_NEAR(obstacles.at(c.obstacle)->distance(where.tip - c.along * where.direction()) - needle.width / 2,
                c.minimum, 1e-11)
        << "reached where it is reported";
    touching += c.minimum < 0;
  }
  EXPECT_GT(touching, 5);
  EXPECT_LT(touching, 60);
}

// Between two samples: a dip that lasts a thousandth of the piece.
TEST(Clearance, AShortDipOfAPieceIsFound) {
  const Block post(0, {.inner = 10, .outer = 12, .left = -1, .right = 1, .low = 0, .high = 20});
  // The tip rises as a parabola over a distance of 1000 mm, needle along the axis, its foremost point downwards.
  const double pointing_down = pi / 2;
  const BezierPiece dip({homogeneous({11, -517, 21 + 2.0 * 517 / 483 * 100, 0, pointing_down}, 1),
                         homogeneous({11, 0, 21, 0, pointing_down}, 40),
                         homogeneous({11, 483, 21 + 200, 0, pointing_down}, 1)});
  const std::vector<BezierPiece> pieces{BezierPiece::line({300, 0, 0, 0, 0}, {300, 0, 9, 0, 0}), dip};
  const Clearance c = clearance(pieces, {2, 30}, {&post}, 1e-5, silent);
  EXPECT_EQ(c.move, 1u);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 200000; ++i) {
    const SplinePoint p = dip.at(i / 200000.0)[0];
    least = std::min(least, post.distance({p[0], p[1], p[2] + 1}) - 1);
  }
  EXPECT_NEAR(c.minimum, least, 2e-5);
}

TEST(Clearance, UpToAValueIsTheLeastClearanceOrThatValue) {
  const Block post(0, {.inner = 10, .outer = 12, .left = -1, .right = 1, .low = 0, .high = 20});
  Random random(46);
  for (int n = 0; n < 200; ++n) {
    const auto pose = [&](double low) {
      return SplinePoint{random.uniform(low, 16), random.uniform(-6, 6), random.uniform(0, 30), random.uniform(0, pi),
                         random.uniform(0, pi / 2)};
    };
    const std::vector<BezierPiece> pieces{BezierPiece::line(pose(4), pose(4))};
    const double least = clearance(pieces, {2, 30}, {&post}, 1e-3, silent).minimum;
    for (const double enough : {least - 1, least - 2e-3, least + 2e-3, least + 1}) {
      const double found = clearance_up_to(pieces, {2, 30}, {&post}, {enough, 1e-3}, silent);
      EXPECT_NEAR(found, std::min(least, enough), 1e-3 + 1e-9);
      EXPECT_LE(found, enough);
    }
  }
}

TEST(Clearance, IsInfiniteWithoutPieces) {
  const Block post(0, {.inner = 10, .outer = 12, .left = -1, .right = 1, .low = 0, .high = 20});
  EXPECT_TRUE(std::isinf(clearance(std::vector<BezierPiece>{}, {2.6, 60}, {&post}, 0.01, silent).minimum));
  const std::vector<BezierPiece> still{BezierPiece::line({20, 0, 5, pi, 0}, {20, 0, 5, pi, 0})};
  EXPECT_NEAR(clearance(still, {2, 60}, {&post}, 1e-6, silent).minimum, 8, 1e-6) << "a piece without length";
  EXPECT_TRUE(std::isinf(clearance(still, {2.6, 60}, {}, 0.01, silent).minimum));
}

TEST(Clearance, ImpossibleNeedlesAreRefused) {
  const std::vector<NeedleMove> none;
  const auto refused = [&](NeedleShape shape) -> std::string {
    try {
      clearance(none, shape, {}, 0.01, silent);
    } catch (const InvalidInput& e) {
      return e.faults.at(0).place.back();
    }
    return "";
  };
  EXPECT_EQ(refused({0, 60}), "width");
  EXPECT_EQ(refused({2.6, 2}), "length");
  EXPECT_EQ(refused({2.6, std::numeric_limits<double>::infinity()}), "length");
  EXPECT_EQ(refused({2.6, 60}), "");
  EXPECT_TRUE(std::isinf(clearance(none, {2.6, 60}, {}, 0.01, silent).minimum));
  EXPECT_THROW(clearance(none, {2.6, 60}, {}, 0, silent), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk::winding
