#include "core/numeric/gauss_legendre.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace bahnwerk {
namespace {

TEST(GaussLegendre, IntegratesPolynomialsUpToDegreeTwoNMinusOne) {
  for (std::size_t n = 1; n <= 12; ++n) {
    std::vector<GaussPoint> rule(n);
    gauss_legendre(rule);
    for (std::size_t degree = 0; degree <= 2 * n; ++degree) {
      double sum = 0;
      for (const auto& [place, weight] : rule) sum += weight * std::pow(place, static_cast<double>(degree));
      const double exact = degree % 2 == 0 ? 2.0 / static_cast<double>(degree + 1) : 0;
      if (degree < 2 * n)
        EXPECT_NEAR(sum, exact, 2e-15) << n << " points, degree " << degree;
      else
        EXPECT_GT(std::abs(sum - exact), 1e-8) << n << " points are not exact for degree " << degree;
    }
  }
}

TEST(GaussLegendre, PlacesAscendAndLieOppositeToEachOther) {
  const auto& rule = gauss_legendre<5>();
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(rule[i].place, -rule[4 - i].place);
    EXPECT_EQ(rule[i].weight, rule[4 - i].weight);
    if (i > 0) {
      EXPECT_LT(rule[i - 1].place, rule[i].place);
    }
  }
  EXPECT_EQ(rule[2].place, 0);
  // The roots of x (63 x⁴ − 70 x² + 15) in closed form.
  EXPECT_NEAR(rule[4].place, std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3, 2e-16);
  EXPECT_NEAR(rule[3].place, std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3, 2e-16);
}

}  // namespace
}  // namespace bahnwerk
