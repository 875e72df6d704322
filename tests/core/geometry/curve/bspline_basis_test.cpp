#include "core/geometry/curve/bspline_basis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk {
namespace {

const std::vector<double> knots{0, 0, 0, 0, 0.7, 1.1, 2, 2, 3.5, 5, 5, 5, 5};  // degree 3, one of them twice

TEST(BsplineBasis, SumsToOneAndItsDerivativesToZero) {
  for (const std::size_t k : {3u, 4u, 5u, 7u, 8u})
    for (int i = 0; i <= 10; ++i) {
      const double u = knots[k] + 0.1 * i * (knots[k + 1] - knots[k]);
      const auto basis = bspline_basis<4>(knots, 3, k, u);
      for (std::size_t order = 0; order < 4; ++order) {
        double sum = 0;
        for (const double value : basis[order]) sum += value;
        EXPECT_NEAR(sum, order == 0 ? 1 : 0, 1e-12) << "order " << order << " at " << u;
      }
      for (const double value : basis[0]) EXPECT_GE(value, 0);
    }
}

TEST(BsplineBasis, IsBernsteinsOnOneInterval) {
  const std::vector<double> clamped{0, 0, 0, 1, 1, 1};
  for (const double u : {0.0, 0.3, 0.8, 1.0}) {
    const auto basis = bspline_basis<3>(clamped, 2, 2, u);
    const double v = 1 - u;
    const double expected[3][3] = {{v * v, 2 * u * v, u * u}, {-2 * v, 2 * v - 2 * u, 2 * u}, {2, -4, 2}};
    for (std::size_t order = 0; order < 3; ++order)
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(basis[order][i], expected[order][i], 1e-15);
  }
}

TEST(BsplineBasis, DerivativesAreThoseOfTheValues) {
  constexpr double h = 1e-5;
  for (const double u : {0.9, 1.6, 2.8}) {
    const std::size_t k = u < 1.1 ? 4 : u < 2 ? 5 : 7;
    const auto before = bspline_basis<4>(knots, 3, k, u - h), at = bspline_basis<4>(knots, 3, k, u),
               after = bspline_basis<4>(knots, 3, k, u + h);
    for (std::size_t order = 0; order < 3; ++order)
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(at[order + 1][i], (after[order][i] - before[order][i]) / (2 * h), 1e-8) << order << ' ' << i;
  }
}

TEST(BsplineBasis, ValuesAloneAreTheSame) {
  for (const double u : {1.2, 1.5, 1.9}) {
    double values[4];
    bspline_values<3>(&knots[5], u, values);
    const auto basis = bspline_basis<4>(knots, 3, 5, u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(values[i], basis[0][i]);
  }
}

}  // namespace
}  // namespace bahnwerk
