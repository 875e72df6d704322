#include "core/numeric/optimise/elastic.hpp"

#include <gtest/gtest.h>

#include "tests/core/numeric/optimise/gradient_check.hpp"
#include "tests/core/numeric/optimise/problems.hpp"

namespace bahnwerk {
namespace {

TEST(ElasticProblem, RowsAreScaledViolationsLessTheSlack) {
  KnownProblem k = hs71();
  k.problem.inequality.scale = {10};
  k.problem.equality.scale = {4};
  const OptimisationProblem elastic = elastic_problem(k.problem);
  ASSERT_EQ(elastic.dimension, 5);
  ASSERT_EQ(elastic.inequality.rows, 3);
  const std::vector<double> x{1, 2, 3, 4, 0.5};
  EXPECT_LT(gradient_error(elastic, x), 1e-7);
  std::vector<double> c(3);
  elastic.inequality.evaluate(x, c, {});
  EXPECT_DOUBLE_EQ(c[0], (25 - 24) / 10.0 - 0.5);
  EXPECT_DOUBLE_EQ(c[1], (30 - 40) / 4.0 - 0.5);
  EXPECT_DOUBLE_EQ(c[2], (40 - 30) / 4.0 - 0.5);
  EXPECT_EQ(elastic.objective(x, {}), 0.5);
}

}  // namespace
}  // namespace bahnwerk
