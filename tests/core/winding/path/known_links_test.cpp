// Links that come back turned about the part's axis.
#include "core/winding/path/known_links.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/base/progress.hpp"
#include "core/geometry/spline/spline_arc.hpp"
#include "core/winding/path/needle_path.hpp"
#include "needle_pieces.hpp"

namespace bahnwerk::winding {
namespace {

/// From a slot into an arc, `farther` mm farther out.
LinkEnds ends(double farther = 0) {
  const auto slot = BezierPiece::line({50, 5, -30, 0.3, 0}, {50, 5, 30, 0.3, 0});
  const auto head = spline_arc({50 + farther, 11, 36, 0.3, 0}, {}, {0, 0, 1}, 0.8, {0, 0, 2, 0.8, 0.1}).front();
  return {slot.at(1), head.at(0)};
}
SplineJet turned(SplineJet jet, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (SplinePoint& p : jet) {
    const double x = p[0], y = p[1];
    p[0] = c * x - s * y, p[1] = s * x + c * y;
  }
  jet[0][3] += angle;
  return jet;
}
LinkEnds turned(const LinkEnds& ends, double angle) { return {turned(ends.before, angle), turned(ends.after, angle)}; }

FoundLink link_of(double smoothness) {
  FoundLink found;
  found.best.smoothness = smoothness;
  return found;
}

SplineJet mirrored(SplineJet jet) {
  for (SplinePoint& p : jet) p[1] = -p[1], p[3] = -p[3];
  return jet;
}
LinkEnds mirrored(const LinkEnds& ends) { return {mirrored(ends.before), mirrored(ends.after)}; }

TEST(KnownLinks, EndsTurnedOrMirroredTogetherAreCongruent) {
  for (const double angle : {0.0, 0.13, 1.7, 3.1, -2.5}) {
    EXPECT_TRUE(congruent(ends(), turned(ends(), angle), 3));
    EXPECT_TRUE(congruent(ends(), turned(mirrored(ends()), angle), 3));
    EXPECT_FALSE(congruent(ends(), {turned(ends(), angle).before, turned(mirrored(ends()), angle).after}, 3));
  }
  EXPECT_FALSE(congruent(ends(), {ends().before, turned(ends().after, 1e-6)}, 3));
  EXPECT_FALSE(congruent(ends(), ends(1e-6), 3));
}

TEST(KnownLinks, EveryDerivativeUpToTheContinuityCounts) {
  for (std::size_t order = 0; order < spline_orders; ++order)
    for (std::size_t d = 0; d < 3; ++d) {
      LinkEnds other = turned(ends(), 0.4);
      other.after[order][d] += 1e-6;
      EXPECT_FALSE(congruent(ends(), other, 4)) << order;
      for (std::size_t continuity = 1; continuity < spline_orders; ++continuity)
        EXPECT_EQ(congruent(ends(), other, continuity), order > continuity) << order;
    }
}

TEST(KnownLinks, FindsTheFirstThatJoinsSuchEnds) {
  KnownLinks known(3);
  EXPECT_EQ(known.find(ends()), nullptr);
  for (int i = 0; i < 20; ++i) known.remember(ends(0.01 * i), link_of(i));
  known.remember(turned(ends(0.05), 1), link_of(100));
  for (int i = 0; i < 20; ++i) {
    const FoundLink* found = known.find(turned(ends(0.01 * i), 0.2 * i));
    ASSERT_NE(found, nullptr) << i;
    EXPECT_EQ(found->best.smoothness, i);
  }
  EXPECT_EQ(known.find(ends(0.005)), nullptr);
}

TEST(KnownLinks, CongruentLinksOfRepeatedCoilsAreTheSame) {
  constexpr std::size_t turns = 4, coils = 3;
  const auto pieces = rotor_pieces(turns, coils);
  SilentProgress progress;
  const NeedlePath path = needle_path(pieces, false, {}, progress);
  const auto place_of = [&](const NeedleLink& link) {
    return std::tuple(pieces[link.from].kind, pieces[link.from].region, pieces[link.from + 1].kind);
  };
  std::size_t same = 0;
  for (std::size_t i = 0; i < path.links.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const NeedleLink &known = path.links[j], &link = path.links[i];
      if (place_of(known) != place_of(link) || !congruent(known.ends, link.ends, 3)) continue;
      EXPECT_EQ(known.best.shape.before, link.best.shape.before);
      EXPECT_EQ(known.best.shape.after, link.best.shape.after);
      if (pieces[known.from].coil != pieces[link.from].coil) ++same;
    }
  EXPECT_GE(same, turns);
}

}  // namespace
}  // namespace bahnwerk::winding
