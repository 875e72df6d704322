#include "core/contour/blend/smooth_basis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk::blending {
namespace {

const std::vector<double> breaks{0, 1, 1.5, 3, 3.2, 5};

TEST(SmoothBasis, BothEndsCountSixTimes) {
  const std::vector<double> knots = clamped_knots(breaks);
  ASSERT_EQ(knots.size(), breaks.size() + 10);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(knots[i], 0);
    EXPECT_EQ(knots[knots.size() - 1 - i], 5);
  }
  EXPECT_EQ(knots[6], 1);
}

TEST(SmoothBasis, ItsValuesSumToOne) {
  const std::vector<double> knots = clamped_knots(breaks);
  for (std::size_t span = 0; span + 1 < breaks.size(); ++span)
    for (const double x : {0.0, 0.4, 1.0}) {
      const double t = breaks[span] + x * (breaks[span + 1] - breaks[span]);
      const BasisRow row = basis_at(knots, span, t), fewer = second_derivative_basis_at(knots, span, t),
                     values = value_basis_at(knots, span, t);
      for (std::size_t order = 0; order < 4; ++order) {
        double sum = 0, size = 1;
        for (std::size_t i = 0; i < spline_order; ++i) sum += row[order][i], size += std::abs(row[order][i]);
        EXPECT_NEAR(sum, order == 0 ? 1 : 0, 1e-13 * size);
      }
      for (std::size_t i = 0; i < spline_order; ++i) {
        EXPECT_EQ(values[0][i], row[0][i]);
        for (std::size_t order = 0; order < 3; ++order) EXPECT_EQ(fewer[order][i], row[order][i]);
        EXPECT_EQ(fewer[3][i], 0);
      }
    }
}

TEST(SmoothBasis, ThirdDerivativesAtManyPlacesAreThoseAtEach) {
  const std::vector<double> knots = clamped_knots(breaks);
  for (std::size_t span = 0; span + 1 < breaks.size(); ++span) {
    const double h = breaks[span + 1] - breaks[span];
    const std::array<double, 3> places{breaks[span] + 0.1 * h, breaks[span] + 0.5 * h, breaks[span] + 0.9 * h};
    const auto third = third_basis_at(knots, span, places);
    for (std::size_t p = 0; p < 3; ++p) {
      const BasisRow row = basis_at(knots, span, places[p]);
      for (std::size_t i = 0; i < spline_order; ++i)
        EXPECT_NEAR(third[p][i], row[3][i], 1e-10 * (1 + std::abs(row[3][i]))) << span << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace bahnwerk::blending
