#include "core/probe/landing.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk::probe {
namespace {

/// Value and three derivatives at h of the polynomial whose coefficients from τ⁴ on are `c`.
std::array<double, 4> state(const std::vector<double>& c, double h) {
  std::array<double, 4> out{};
  for (std::size_t i = 0; i < c.size(); ++i) {
    double factor = c[i];
    const double power = static_cast<double>(i + 4);
    for (std::size_t order = 0; order < 4; ++order) {
      out[order] += factor * std::pow(h, power - static_cast<double>(order));
      factor *= power - static_cast<double>(order);
    }
  }
  return out;
}

TEST(Landing, EndsInTheStateThatIsAskedFor) {
  for (const double h : {0.01, 1.0, 7.0}) {
    const std::array<double, 4> wanted{3, -2 / h, 5 / (h * h), 40 / (h * h * h)};
    const auto c = landing<double>(wanted[0], wanted[1], wanted[2], wanted[3], h);
    const auto reached = state({c.begin(), c.end()}, h);
    for (std::size_t order = 0; order < 4; ++order)
      EXPECT_NEAR(reached[order], wanted[order], 1e-12 * std::abs(wanted[order])) << h << " " << order;
  }
}

TEST(Landing, WithoutAValueTheDegreeIsOneLess) {
  const double h = 0.3;
  const auto c = landing<double>(-2.0, 5.0, 40.0, h);
  const auto reached = state({c.begin(), c.end()}, h);
  EXPECT_NEAR(reached[1], -2, 1e-12);
  EXPECT_NEAR(reached[2], 5, 1e-11);
  EXPECT_NEAR(reached[3], 40, 1e-10);
  const auto whole = landing<double>(reached[0], -2.0, 5.0, 40.0, h);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(whole[i], c[i], 1e-11 * std::abs(c[i]));
  EXPECT_NEAR(whole[3] * std::pow(h, 7), 0, 1e-13);
}

TEST(Landing, VectorsLandCoordinateByCoordinate) {
  const auto both = landing<Vec>(Vec{1, 0, 0}, Vec{0, 2, 0}, Vec{0, 0, 3}, Vec{}, 0.5);
  const auto z = landing<double>(0.0, 0.0, 3.0, 0.0, 0.5);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(both[i].z, z[i]);
}

}  // namespace
}  // namespace bahnwerk::probe
