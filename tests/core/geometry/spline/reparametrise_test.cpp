#include "core/geometry/spline/reparametrise.hpp"

#include <gtest/gtest.h>

#include "tests/core/geometry/spline/spline_support.hpp"

namespace bahnwerk {
namespace {

Betas random_betas(Random& random) {
  return {random.uniform(0.3, 3), random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
}

TEST(Reparametrise, RevertedSeriesUndoesTheSeries) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const auto b = random_betas(random);
    const auto f = Series::from(0, b[0], b[1], b[2], b[3]);
    for (const auto& one : {composed(f, reverted(f)), composed(reverted(f), f)})
      for (std::size_t n = 0; n < spline_orders; ++n) EXPECT_NEAR(one.c[n], n == 1 ? 1 : 0, 1e-9);
  }
}

// The scheme as the source has it: (4.49) and (4.50) for k = 4, solved one after the other for the link's derivatives.
TEST(Reparametrise, IsTheInverseFaaDiBrunoScheme) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const auto b = random_betas(random);
    const double b1 = b[0], b2 = b[1], b3 = b[2], b4 = b[3];
    SplineJet s{};
    for (auto& derivative : s) derivative = testing::random_pose(random, 3);
    const SplineJet link = reparametrised(s, inverse_change(b));
    for (std::size_t d = 0; d < spline_dimension; ++d) {
      const double e1 = s[1][d] / b1, e2 = (s[2][d] - b2 * e1) / (b1 * b1),
                   e3 = (s[3][d] - 3 * e2 * b1 * b2 - e1 * b3) / (b1 * b1 * b1),
                   e4 = (s[4][d] - 6 * e3 * b1 * b1 * b2 - e2 * (4 * b1 * b3 + 3 * b2 * b2) - e1 * b4) /
                        (b1 * b1 * b1 * b1);
      const double expected[] = {s[0][d], e1, e2, e3, e4};
      for (std::size_t n = 0; n < spline_orders; ++n)
        EXPECT_NEAR(link[n][d], expected[n], 1e-10 * (1 + std::abs(expected[n]))) << n;
    }
  }
}

TEST(Reparametrise, BetaDerivativesAreThoseOfDifferences) {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const auto b = random_betas(random);
    SplineJet s{};
    for (auto& derivative : s) derivative = testing::random_pose(random, 3);
    const Series change = inverse_change(b);
    const SplineJet link = reparametrised(s, change);
    for (std::size_t j = 1; j <= 4; ++j) {
      const auto slope = beta_derivative(link, change, j);
      Betas low = b, high = b;
      const double h = 1e-5;
      low[j - 1] -= h, high[j - 1] += h;
      const auto a = reparametrised(s, inverse_change(low)), c = reparametrised(s, inverse_change(high));
      for (std::size_t n = 0; n < spline_orders; ++n)
        for (std::size_t d = 0; d < spline_dimension; ++d)
          EXPECT_NEAR(slope[n][d], (c[n][d] - a[n][d]) / (2 * h),
                      1e-5 * (1 + testing::size(slope[n]) + testing::size(link[n])))
              << j << ' ' << n;
    }
  }
}

TEST(Reparametrise, DerivativesByLengthHaveUnitTangentAndDoNotDependOnTheParameter) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    SplineJet s{};
    for (auto& derivative : s) derivative = testing::random_pose(random, 3);
    const auto a = by_length(s), b = by_length(reparametrised(s, inverse_change(random_betas(random))));
    EXPECT_NEAR(norm(place(a[1])), 1, 1e-12);
    EXPECT_NEAR(dot(place(a[1]), place(a[2])), 0, 1e-10 * testing::size(a[2]));
    for (std::size_t n = 0; n < spline_orders; ++n)
      EXPECT_LE(testing::distance(a[n], b[n]), 1e-8 * (1 + testing::size(a[n]))) << n;
  }
}

}  // namespace
}  // namespace bahnwerk
