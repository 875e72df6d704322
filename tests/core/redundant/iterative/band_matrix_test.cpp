#include "core/redundant/iterative/band_matrix.hpp"

#include <gtest/gtest.h>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

TEST(BandMatrix, SolvesWhatRowsMake) {
  Random random(1);
  for (const std::size_t n : {1u, 2u, 5u, 40u}) {
    const std::size_t band = 3;
    BandMatrix a(n, band);
    for (int i = 0; i < 200; ++i) {
      VariableRow row;
      row.count = std::min<std::size_t>(band + 1, n);
      row.first = static_cast<std::size_t>(random.below(n - row.count + 1));
      for (std::size_t r = 0; r < row.count; ++r) row.weights[r] = random.uniform(-1, 1);
      a.add(row, random.uniform(0.1, 1));
    }
    std::vector<double> x(n), b(n, 0.0);
    for (double& v : x) v = random.uniform(-1, 1);
    a.multiply(x, b);
    BandMatrix factor = a;
    ASSERT_TRUE(factor.factor());
    factor.solve(b);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(b[i], x[i], 1e-11);
  }
}

TEST(BandMatrix, KnowsWhenItIsSingular) {
  BandMatrix a(3, 1);
  VariableRow row;
  row.count = 2;
  row.weights = {1, -1};
  a.add(row, 1);
  row.first = 1;
  a.add(row, 1);  // only differences
  EXPECT_FALSE(a.factor());
}

}  // namespace
}  // namespace bahnwerk
