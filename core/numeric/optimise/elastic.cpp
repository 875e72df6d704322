#include "core/numeric/optimise/elastic.hpp"

#include <algorithm>
#include <limits>

namespace bahnwerk {

OptimisationProblem elastic_problem(const OptimisationProblem& problem) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t n = problem.dimension, inequalities = problem.inequality.rows, equalities = problem.equality.rows;
  OptimisationProblem elastic;
  elastic.dimension = n + 1;
  const auto extended = [n](std::vector<double> values, double otherwise, double last) {
    if (values.empty()) values.assign(n, otherwise);
    values.push_back(last);
    return values;
  };
  elastic.lower = extended(problem.lower, -infinity, 0);
  elastic.upper = extended(problem.upper, infinity, infinity);
  elastic.scale = extended(problem.scale, 1, 1);
  elastic.objective = [n](std::span<const double> x, std::span<double> gradient) {
    std::ranges::fill(gradient, 0);
    if (!gradient.empty()) gradient[n] = 1;
    return x[n];
  };
  elastic.inequality.rows = inequalities + 2 * equalities;
  elastic.inequality.evaluate = [&problem, n, inequalities, equalities](
                                    std::span<const double> x, std::span<double> values, std::span<double> jacobian) {
    const std::span<const double> point = x.first(n);
    std::vector<double> c(std::max(inequalities, equalities)), slope(jacobian.empty() ? 0 : n * c.size());
    std::size_t row = 0;
    const auto append = [&](const Constraints& from, double sign) {
      for (std::size_t i = 0; i < from.rows; ++i, ++row) {
        const double factor = sign / (from.scale.empty() ? 1 : from.scale[i]);
        values[row] = factor * c[i] - x[n];
        if (jacobian.empty()) continue;
        for (std::size_t j = 0; j < n; ++j) jacobian[row * (n + 1) + j] = factor * slope[i * n + j];
        jacobian[row * (n + 1) + n] = -1;
      }
    };
    const auto fill = [&](const Constraints& from) {
      std::ranges::fill(slope, std::numeric_limits<double>::quiet_NaN());
      from.evaluate(point, std::span(c).first(from.rows), std::span(slope).first(jacobian.empty() ? 0 : n * from.rows));
    };
    if (inequalities > 0) {
      fill(problem.inequality);
      append(problem.inequality, 1);
    }
    if (equalities > 0) {
      fill(problem.equality);
      append(problem.equality, 1);
      append(problem.equality, -1);
    }
  };
  return elastic;
}

}  // namespace bahnwerk
