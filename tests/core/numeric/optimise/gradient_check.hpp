#pragma once
/// Gradients written by hand against central differences: for the tests of every problem given to minimise().
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/numeric/optimise/optimise.hpp"

namespace bahnwerk {

/// Largest difference between the callbacks' derivatives at x and central differences with step `step` · max(1, |xⱼ|),
/// over the objective and all rows, relative to max(1, |derivative|). About 1e-8 for smooth functions of order 1 and
/// the step given.
inline double gradient_error(const OptimisationProblem& problem, std::vector<double> x, double step = 1e-5) {
  const std::size_t n = x.size(), m = problem.inequality.rows;
  const auto values = [&](std::span<double> gradient, std::span<double> jacobian) {
    std::vector<double> all(1 + m);
    all[0] = problem.objective(x, gradient);
    if (m > 0) problem.inequality.evaluate(x, std::span(all).subspan(1), jacobian);
    return all;
  };
  std::vector<double> slopes(n * (1 + m));
  values(std::span(slopes).first(n), std::span(slopes).subspan(n));
  double worst = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const double at = x[j], h = step * std::max(1.0, std::abs(at));
    x[j] = at + h;
    const std::vector<double> above = values({}, {});
    x[j] = at - h;
    const std::vector<double> below = values({}, {});
    x[j] = at;
    for (std::size_t i = 0; i < above.size(); ++i) {
      const double slope = slopes[i * n + j], difference = (above[i] - below[i]) / (2 * h);
      worst = std::max(worst, std::abs(slope - difference) / std::max(1.0, std::abs(slope)));
    }
  }
  return worst;
}

}  // namespace bahnwerk
