#include "core/geometry/spline/search/best_link.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/geometry/spline/spline_arc.hpp"

namespace bahnwerk {
namespace {

/// The source's rotor: slot and front are straight, 60 and 13 mm, the link turns by 90 degrees.
LinkEnds rotor() {
  const auto slot = BezierPiece::line({50, 5, -30, 0, 0}, {50, 5, 30, 0, 0});
  const auto front = BezierPiece::line({50, 11, 36, 0, 0}, {50, 24, 36, 0, 0});
  return {slot.at(1), front.at(0)};
}
LinkEnds stator() {
  const auto slot = BezierPiece::line({40, 0, -30, 0, 0}, {40, 0, 30, 0, 0});
  const auto head = spline_arc({52, 6, 40, 0, 1.5}, {}, {0, 0, 1}, 1.2, {0, 0, 0, 1.2, 0}).front();
  return {slot.at(1), head.at(0)};
}

TEST(BestLink, CurvatureIsSmoothest) {
  Progress progress;
  const SmoothnessWeights weights;
  for (const bool straight : {true, false}) {
    const LinkEnds ends = straight ? rotor() : stator();
    const SmoothnessRule rule(3, 64);
    const double parametric = smoothness(rule, ends, {}, weights);
    const auto distance = best_link(rule, ends, {LinkObjective::control_distance, weights}, progress);
    const auto curvature = best_link(rule, ends, {LinkObjective::curvature, weights}, progress);
    const auto warm = best_link(rule, ends, {LinkObjective::curvature, weights, distance.shape}, progress);
    EXPECT_LT(curvature.smoothness, distance.smoothness);
    EXPECT_LT(curvature.smoothness, parametric);
    EXPECT_LE(warm.smoothness, distance.smoothness);
    EXPECT_LE(distance.objective, control_distance(3, ends, {}));
    // Beside an arc (4.61) is no measure of smoothness: its link may be worse than the C³ one.
    if (straight) {
      EXPECT_LT(distance.smoothness, parametric);
    }
  }
}

// β by the ends' own parameters give the link that was judged.
TEST(BestLink, ShapeBelongsToTheEndsAsGiven) {
  Progress progress;
  for (std::size_t k = 1; k <= 4; ++k) {
    const SmoothnessRule rule(k);
    const SmoothnessWeights weights{1, 8, true, 1e-5};
    const auto best = best_link(rule, stator(), {LinkObjective::control_distance, weights}, progress);
    EXPECT_NEAR(smoothness(rule, stator(), best.shape, weights), best.smoothness, 1e-8 * best.smoothness);
    EXPECT_NEAR(control_distance(k, stator(), best.shape), best.objective, 1e-8 * (1 + best.objective));
  }
}

}  // namespace
}  // namespace bahnwerk
