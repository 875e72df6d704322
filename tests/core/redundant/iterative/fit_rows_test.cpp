#include "core/redundant/iterative/fit_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/redundant/iterative/coarse_tasks.hpp"

namespace bahnwerk {
namespace {

using test::clamped, test::task_of, test::wave;

/// Control points that no fit would choose.
std::vector<double> any_variables(const FitRows& fit) {
  std::vector<double> y(fit.ends.variables());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = 10 * std::sin(1.7 * static_cast<double>(i));
  return y;
}

TEST(FitRows, ErrorsAreTheSplineLessTheSamples) {
  CoarseTask task = task_of(1, 101, 1, wave);
  task.begin = {3, 40, -500, 3};
  const FitRows fit(task, 4, clamped(4, {0.2, 0.4, 0.6, 0.8}));
  const std::vector<double> y = any_variables(fit), controls = fit.ends.controls(y);
  double most = 0;
  std::size_t span = 0;
  for (std::size_t i = 0; i + 1 < task.positions.size(); ++i) {
    const SplineRow row = fit.space.at(task.time(i + 1), 0, span);
    double x = 0;
    for (std::size_t r = 0; r < row.count; ++r) x += row.weights[r] * controls[row.first + r];
    const double error = x - task.positions[i + 1];
    EXPECT_NEAR(fit.error(task, y, i), error, 1e-11) << i;
    most = std::max(most, std::abs(error));
  }
  EXPECT_NEAR(fit.largest_error(task, y), most, 1e-11);
}

TEST(FitRows, TheNormalSystemIsTheGradientOfTheSumOfSquares) {
  const CoarseTask task = task_of(1, 101, 1, wave);
  const FitRows fit(task, 3, clamped(3, {0.25, 0.5, 0.75}));
  std::vector<double> y = any_variables(fit), right, gradient(y.size(), 0);
  const SymmetricBand<> matrix = fit.normal(task, right);
  matrix.multiply(y, gradient);
  const auto squares = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < fit.rows.size(); ++i) sum += std::pow(fit.error(task, y, i), 2);
    return sum;
  };
  for (std::size_t i = 0; i < y.size(); ++i) {
    constexpr double step = 0.5;  // the sum is quadratic: central differences are exact
    y[i] += step;
    const double more = squares();
    y[i] -= 2 * step;
    const double less = squares();
    y[i] += step;
    EXPECT_NEAR(2 * (gradient[i] - right[i]), (more - less) / (2 * step), 1e-9 * (more + less)) << i;
  }
}

}  // namespace
}  // namespace bahnwerk
