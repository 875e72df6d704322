#pragma once
/// Minimising without progress, what is expected of it, and a problem for every occasion.
#include <gmock/gmock.h>

#include <limits>
#include <vector>

#include "core/base/progress.hpp"
#include "core/numeric/optimise/optimise.hpp"
#include "tests/core/numeric/optimise/problems.hpp"

namespace bahnwerk::test {

using Method = OptimisationMethod;
inline constexpr double infinity = std::numeric_limits<double>::infinity(),
                        nan = std::numeric_limits<double>::quiet_NaN();

inline OptimisationResult solve(const OptimisationProblem& problem, const std::vector<double>& start,
                                OptimisationOptions options = {}) {
  Progress silent;
  return minimise(problem, start, options, silent);
}

inline void expect_minimum(const KnownProblem& known, const OptimisationResult& found, double f_tolerance,
                           double x_tolerance) {
  EXPECT_NEAR(found.objective, known.minimum, f_tolerance);
  EXPECT_LE(found.violation, 1e-8);
  ASSERT_EQ(found.x.size(), known.problem.dimension);
  for (std::size_t j = 0; j < known.x.size(); ++j) EXPECT_NEAR(found.x[j], known.x[j], x_tolerance) << j;
}

inline OptimisationProblem parabola(std::size_t n, double at) {
  OptimisationProblem p;
  p.dimension = n;
  p.objective = [at](Point x, Values g) {
    double sum = 0;
    for (std::size_t j = 0; j < x.size(); ++j) {
      if (!g.empty()) g[j] = 2 * (x[j] - at);
      sum += (x[j] - at) * (x[j] - at);
    }
    return sum;
  };
  return p;
}

}  // namespace bahnwerk::test
