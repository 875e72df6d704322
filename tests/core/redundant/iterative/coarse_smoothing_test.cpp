#include "core/redundant/iterative/coarse_smoothing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/redundant/iterative/coarse_tasks.hpp"

namespace bahnwerk {
namespace {

using test::clamped, test::energy, test::largest_error, test::task_of, test::wave;

/// Of splines with the same knots the quadratic program's has the least energy, the linear one's the least peak.
TEST(CoarseFit, SecondPhasesAreSmootherThanTheFirst) {
  const CoarseTask task = task_of(1, 1001, 20, wave);
  CoarseFitOptions o;
  o.afterburner = 1;
  std::vector<double> energies, peaks;
  for (const auto& smoothing : coarse_smoothings) {
    o.smoothing = smoothing.value;
    const auto fit = fit_coarse(task, o);
    ASSERT_TRUE(fit);
    energies.push_back(energy(fit->spline));
    double peak = 0;
    for (std::size_t i = 0; i < fit->spline.pieces(); ++i)  // linear in between
      for (const double t : {fit->spline.begin(i), fit->spline.end(i)})
        peak = std::max(peak, std::abs(fit->spline.in_piece(i, t).a));
    peaks.push_back(peak);
  }
  EXPECT_LT(energies[1], energies[0]);               // smoothing spline
  EXPECT_LT(energies[2], energies[1] * (1 + 1e-3));  // quadratic program
  for (const double peak : peaks) EXPECT_GE(peak, peaks[3] * (1 - 1e-3));
}

TEST(CoarseFit, LeastSquaresAreSmoothedAsFarAsTheLimitsNeedAndTheToleranceAllows) {
  // 40 mm from rest to rest: few control points, which would take 20 000 mm/s² and 5 of 20 mm.
  const auto move = [](double t) { return 20 * (1 - std::cos(M_PI * t / 0.1)); };
  CoarseTask task = task_of(0.1, 101, 20, move);
  CoarseFitOptions o;
  o.smoothing = CoarseSmoothing::none;
  const auto peak = [](const TimeSpline& s) {
    double most = 0;
    for (int i = 0; i <= 1000; ++i) most = std::max(most, std::abs(s.in_piece(s.find(1e-4 * i, 0), 1e-4 * i).a));
    return most;
  };
  task.limits = {1e5, 1e6};
  const double rough = peak(fit_coarse(task, o)->spline);
  EXPECT_GT(rough, 17000);
  task.limits = {1e5, 15000};
  const auto fit = fit_coarse(task, o);
  EXPECT_LE(peak(fit->spline), 15000);
  EXPECT_GE(peak(fit->spline), 0.9 * 15000);  // no smoother than that
  EXPECT_LE(largest_error(task, fit->spline), 20);
  task.limits = {1e5, 1000};  // cannot be: the tolerance holds all the same
  EXPECT_LE(largest_error(task, fit_coarse(task, o)->spline), 20);
}

/// The integral is summed by midpoints.
TEST(CoarseSmoothing, TheEnergyIsTheIntegralOfTheSquaredAcceleration) {
  CoarseTask task = task_of(1, 101, 1, wave);
  task.begin = {5, 30, 0};
  const FitRows fit(task, 3, clamped(3, {0.3, 0.5, 0.8}));
  std::vector<double> linear, y(fit.ends.variables()), product(y.size(), 0);
  const SymmetricBand<> matrix = bahnwerk::energy(fit, linear);
  const auto integral = [&] {
    const std::vector<double> controls = fit.ends.controls(y);
    double sum = 0;
    std::size_t span = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      const SplineRow row = fit.space.at((i + 0.5) / n, 2, span);
      double a = 0;
      for (std::size_t r = 0; r < row.count; ++r) a += row.weights[r] * controls[row.first + r];
      sum += a * a / n;
    }
    return sum;
  };
  const double constant = integral();
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = 3 * std::cos(2.3 * static_cast<double>(i));
  matrix.multiply(y, product);
  double form = 0, slope = 0;
  for (std::size_t i = 0; i < y.size(); ++i) form += product[i] * y[i], slope += linear[i] * y[i];
  const double found = integral();
  // `matrix` is half of the Hessian, and `linear` half of the gradient at 0.
  EXPECT_NEAR(form + 2 * slope + constant, found, 1e-6 * found);
}

}  // namespace
}  // namespace bahnwerk
