/// The mode itself, integrated: it rests behind the law, and does not without the conditions.
#include "core/cam/optimal/program/vibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/cam/optimal/optimal_law.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

/// Energy amplitude of x″ + 2ζω x′ + ω² x = −s″ at the law's end, from rest: Runge–Kutta.
double residual(const CamLaw& law, double hertz, double damping) {
  const double omega = 2 * std::numbers::pi * hertz;
  const int steps = 4000;
  const double dt = law.duration() / steps;
  double x = 0, v = 0;
  const auto acceleration = [&](double t, double x_, double v_) {
    return -law.evaluate(std::min(t, law.begin() + law.duration()), 2) - 2 * damping * omega * v_ - omega * omega * x_;
  };
  for (int i = 0; i < steps; ++i) {
    const double t = law.begin() + i * dt;
    const double k1 = v, l1 = acceleration(t, x, v);
    const double k2 = v + dt / 2 * l1, l2 = acceleration(t + dt / 2, x + dt / 2 * k1, k2);
    const double k3 = v + dt / 2 * l2, l3 = acceleration(t + dt / 2, x + dt / 2 * k2, k3);
    const double k4 = v + dt * l3, l4 = acceleration(t + dt, x + dt * k3, k4);
    x += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    v += dt / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
  }
  return std::hypot(x, v / omega);
}

TEST(Vibration, ModesRestBehindTheLaw) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(30, 0.5);
  problem.degree = 7;
  problem.pieces = 3;
  const OptimalLaw plain = plan_optimal_law(problem, progress);
  problem.points.front().still = problem.points.back().still = true;
  problem.vibration = {{5, 0.03}, {11, 0}};
  const OptimalLaw quiet = plan_optimal_law(problem, progress);
  for (const VibrationMode& mode : problem.vibration) {
    EXPECT_GT(residual(plain.solution.law, mode.frequency, mode.damping), 1e-3);
    EXPECT_LT(residual(quiet.solution.law, mode.frequency, mode.damping), 1e-8);
  }
  EXPECT_GE(quiet.solution.value.objective, plain.solution.value.objective * (1 - 1e-8));
}

}  // namespace
}  // namespace bahnwerk::cam
