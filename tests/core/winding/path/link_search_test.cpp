// The link at one place: no cusps, no loops, the same from turn to turn.
#include "core/winding/path/link_search.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/progress.hpp"
#include "core/geometry/spline/spline_arc.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;

/// From a slot into a line across it, `shift` mm farther out: a turn by 90 degrees.
LinkEnds corner(double shift) {
  const auto slot = BezierPiece::line({50, 5, -30, 0, 0}, {50, 5, 30, 0, 0});
  const auto front = BezierPiece::line({50 + shift, 11, 36, 0, 0}, {50 + shift, 24, 36, 0, 0});
  return {slot.at(1), front.at(0)};
}

TEST(LinkSearch, TurnedAngleAndSharpestBendOfACircle) {
  const auto arc = spline_arc({4, 0, 0, 0, 0}, {}, {0, 0, 1}, 1.3).front();
  EXPECT_NEAR(turned_angle(arc), 1.3, 1e-4);
  EXPECT_NEAR(sharpest_curvature(arc), 0.25, 1e-6);
  EXPECT_EQ(sharpest_curvature(BezierPiece::line({}, {1})), 0);
}

// A cubic whose speed falls to 0.01 of its chord at a bend: no sample sees it, the minimum of the speed does.
TEST(LinkSearch, SharpestBendSeesWhatIsNarrow) {
  const double d = 1e-3;
  const BezierPiece cusp(
      {homogeneous({0, 0}, 1), homogeneous({1 + d, 1}, 1), homogeneous({-d, 1}, 1), homogeneous({1, 0}, 1)});
  EXPECT_GT(sharpest_curvature(cusp), 100);
}

TEST(LinkSearch, FindsABendAndTheSameFromItsNeighbour) {
  Progress progress;
  const LinkOptions options;
  const LinkSearch search(options);
  const FoundLink first = search.find(corner(0), std::nullopt, progress);
  EXPECT_FALSE(first.cusped());
  EXPECT_LT(turned_angle(link(3, corner(0), first.best.shape)), pi / 2 + 0.2);
  const FoundLink next = search.find(corner(0.5), first, progress),
                  alone = search.find(corner(0.5), std::nullopt, progress);
  EXPECT_NEAR(next.best.smoothness, alone.best.smoothness, 0.02 * alone.best.smoothness);
}

TEST(LinkSearch, TheSmoothestIsSmootherThanTheSubstituteAndThatThanTheParametricLink) {
  Progress progress;
  LinkOptions options;
  const double smoothest = LinkSearch(options).find(corner(0), std::nullopt, progress).best.smoothness;
  options.objective = LinkObjective::control_distance;
  const FoundLink substitute = LinkSearch(options).find(corner(0), std::nullopt, progress);
  EXPECT_EQ(substitute.objective, LinkObjective::control_distance);
  EXPECT_LT(smoothest, substitute.best.smoothness);
  EXPECT_LT(substitute.best.smoothness, smoothness(SmoothnessRule(3, 256), corner(0), {}, {}));
}

}  // namespace
}  // namespace bahnwerk::winding
