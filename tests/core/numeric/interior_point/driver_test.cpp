#include "core/numeric/interior_point/driver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bahnwerk {
namespace {

/// minimise x so that x ≥ 1: x − 1 = s, z = 1.
struct Ray final : InteriorPointProblem {
  double x = 5, s = 4, z = 0.5;
  double change_x = 0, change_z = 0;
  bool predicts = true, moves = true;
  double product = 0;
  int restarts = 0;

  InteriorPointFigures evaluate(double) override { return {1, s * z, 1, std::abs(x - 1 - s)}; }
  double dual_residual() override { return std::abs(1 - z); }
  bool factor() override { return true; }
  void direct(double mu) {
    change_z = 1 - z;
    change_x = (mu - product - s * z - s * change_z) / z;
  }
  std::optional<double> predict() override {
    if (!predicts) return std::nullopt;
    product = 0;
    direct(0);
    product = change_x * change_z;
    const double a = step_length(-change_x / s, 1), b = step_length(-change_z / z, 1);
    return (s + a * change_x) * (z + b * change_z) / (s * z);
  }
  StepLengths step(double mu) override {
    if (!moves) return {0, 0};
    direct(mu);
    const double a = step_length(-change_x / s), b = step_length(-change_z / z);
    x += a * change_x, s += a * change_x, z += b * change_z;
    return {a, b};
  }
  void restart(double) override { ++restarts; }
};

TEST(InteriorPointDriver, StepsGoNoFurtherThanAPartOfTheWayToTheBoundary) {
  EXPECT_EQ(step_length(0), 1);
  EXPECT_EQ(step_length(0.5), 1);
  EXPECT_EQ(step_length(1), to_boundary);
  EXPECT_EQ(step_length(2), 0.5 * to_boundary);
  EXPECT_EQ(step_length(4, 0.8), 0.2);
}

TEST(InteriorPointDriver, FindsTheOptimumWithAndWithoutAPredictor) {
  for (const bool predicts : {true, false}) {
    Ray ray;
    ray.predicts = predicts;
    const InteriorPointResult result = run_interior_point(ray, {}, 0.5);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(result.iterations, 20);
    EXPECT_LE(result.gap, 1e-9);
    EXPECT_NEAR(ray.x, 1, 1e-8);
  }
}

TEST(InteriorPointDriver, EndsAtTheLargestNumberOfIterationsAndWhereThereIsNoStep) {
  Ray ray;
  int ticks = 0;
  InteriorPointRule rule;
  rule.max_iterations = 3;
  rule.tick = [&] { ++ticks; };
  EXPECT_FALSE(run_interior_point(ray, rule).converged);
  EXPECT_EQ(ticks, 4);

  Ray broken;
  broken.s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(run_interior_point(broken, {}).iterations, 0);
}

TEST(InteriorPointDriver, RestartsWhereStepsStayShort) {
  Ray ray;
  ray.predicts = ray.moves = false;
  InteriorPointRule rule;
  rule.max_iterations = 7;
  run_interior_point(ray, rule, 0.5);
  EXPECT_EQ(ray.restarts, 2);
}

}  // namespace
}  // namespace bahnwerk
