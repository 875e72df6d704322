#include "core/redundant/iterative/coarse_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/redundant/iterative/coarse_tasks.hpp"

namespace bahnwerk {
namespace {

using test::energy, test::largest_error, test::task_of, test::wave;

TEST(CoarseFit, EveryPairOfMethodsStaysWithinTheTolerance) {
  const CoarseTask task = task_of(1, 1001, 20, wave);
  for (const auto& approximation : coarse_approximations)
    for (const auto& smoothing : coarse_smoothings)
      for (const auto& [degree, multiplicity] : {std::pair{2u, 1u}, {3u, 1u}, {3u, 2u}, {4u, 2u}, {5u, 1u}}) {
        SCOPED_TRACE(std::string(approximation.name) + " " + smoothing.name + " " + std::to_string(degree));
        CoarseFitOptions o;
        o.approximation = approximation.value;
        o.smoothing = smoothing.value;
        o.degree = degree;
        o.multiplicity = multiplicity;
        const std::optional<CoarseFit> fit = fit_coarse(task, o);
        ASSERT_TRUE(fit);
        EXPECT_LE(largest_error(task, fit->spline), 20 * (1 + 1e-6));
        EXPECT_NEAR(fit->error, largest_error(task, fit->spline), 1e-6);
        EXPECT_LT(fit->knots, 60u);
        const AxisState a = fit->spline.in_piece(0, 0);
        const AxisState b = fit->spline.in_piece(fit->spline.pieces() - 1, 1);
        EXPECT_NEAR(a.x, task.begin.position, 1e-10);
        EXPECT_NEAR(a.v, 0, 1e-8);
        EXPECT_NEAR(b.v, 0, 1e-8);
      }
}

TEST(CoarseFit, AHeadThatStaysWithinTheStrokeLeavesTheCoarseAxisAlmostStill) {
  const CoarseTask task = task_of(1, 500, 20, [](double t) { return 10 * std::sin(30 * t) * std::sin(M_PI * t); });
  CoarseFitOptions o;
  o.smoothing = CoarseSmoothing::quadratic_program;
  const auto fit = fit_coarse(task, o);
  ASSERT_TRUE(fit);
  EXPECT_LT(energy(fit->spline), 1e-2);
}

TEST(CoarseFit, ProgramsHoldLimitsInBothForms) {
  // 300 mm in 0.35 s: the smoothest motion within ±20 mm would exceed 1100 mm/s.
  const auto move = [](double t) { return t < 0.35 ? 150 * (1 - std::cos(M_PI * t / 0.35)) : 300; };
  CoarseTask task = task_of(0.45, 450, 20, move);
  CoarseFitOptions o;
  o.afterburner = 12;
  const auto peak_speed = [](const TimeSpline& s) {
    double most = 0;
    for (int i = 0; i <= 9000; ++i) most = std::max(most, std::abs(s.in_piece(s.find(5e-5 * i, 0), 5e-5 * i).v));
    return most;
  };
  task.limits = {1e6, 1e6};
  const double free_speed = peak_speed(fit_coarse(task, o)->spline);
  task.limits = {0.93 * free_speed, 60000};
  for (const bool sampled : {false, true}) {
    o.sampled_limits = sampled;
    const auto fit = fit_coarse(task, o);
    ASSERT_TRUE(fit);
    EXPECT_TRUE(fit->limits_met);
    EXPECT_LE(peak_speed(fit->spline), task.limits.velocity * (1 + 1e-3));
    EXPECT_LE(largest_error(task, fit->spline), 20 * (1 + 1e-6));
  }
  task.limits = {0.3 * free_speed, 60000};  // cannot be: the tolerance holds all the same
  const auto fit = fit_coarse(task, o);
  ASSERT_TRUE(fit);
  EXPECT_FALSE(fit->limits_met);
  EXPECT_LE(largest_error(task, fit->spline), 20 * (1 + 1e-6));
}

TEST(CoarseFit, BeginsWhereItIsTold) {
  CoarseTask task = task_of(1, 1001, 20, wave);
  task.begin = {12, -150, 900, 3};
  CoarseFitOptions o;
  o.degree = 4;
  for (const auto& smoothing : coarse_smoothings) {
    o.smoothing = smoothing.value;
    const auto fit = fit_coarse(task, o);
    ASSERT_TRUE(fit);
    const AxisState a = fit->spline.in_piece(0, 0);
    EXPECT_NEAR(a.x, 12, 1e-10);
    EXPECT_NEAR(a.v, -150, 1e-8);
    EXPECT_NEAR(a.a, 900, 1e-5);
    EXPECT_LE(largest_error(task, fit->spline), 20 * (1 + 1e-6));
  }
}

/// Positions of 1e-13 mm more or less make no other fit, and the programs are solved to their end.
TEST(CoarseFit, ProgramsAreSolvedToTheEndHoweverFewTheVariables) {
  const auto move = [](double t) { return t < 0.35 ? 150 * (1 - std::cos(M_PI * t / 0.35)) : 300; };
  CoarseTask here = task_of(0.45, 450, 20, move), there = here;
  for (double& x : there.positions) x = (x + 1234.5) - 1234.5;
  for (const auto smoothing : {CoarseSmoothing::quadratic_program, CoarseSmoothing::linear_program}) {
    CoarseFitOptions o;
    o.smoothing = smoothing;
    int ticks = 0;
    o.tick = [&] { ++ticks; };
    const auto a = fit_coarse(here, o);
    EXPECT_LE(ticks, 50);  // of knots and of one program; it ended after 80 where it did not converge
    const auto b = fit_coarse(there, o);
    for (int i = 0; i <= 450; ++i) {
      const double t = 1e-3 * i;
      EXPECT_NEAR(a->spline.in_piece(a->spline.find(t, 0), t).x, b->spline.in_piece(b->spline.find(t, 0), t).x, 1e-8);
    }
  }
}

}  // namespace
}  // namespace bahnwerk
