#include "core/numeric/chebyshev.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/polynomial.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

const auto wave = [](double u) { return std::exp(std::sin(u)); };

TEST(Chebyshev, InterpolatesASmoothFunctionToRounding) {
  const Chebyshev series = Chebyshev::fit(wave, 2, 5, 30);
  for (double u = 2; u <= 5; u += 0.013) EXPECT_NEAR(series(u), wave(u), 5e-15);
  EXPECT_LT(series.tail(28), 1e-13);
}

TEST(Chebyshev, HitsItsNodes) {
  const Chebyshev series = Chebyshev::fit(wave, -1, 7, 9);
  for (double x : Chebyshev::lobatto(9)) EXPECT_NEAR(series(3 + 4 * x), wave(3 + 4 * x), 1e-14);
}

TEST(Chebyshev, DerivativeAndIntegral) {
  const Chebyshev series = Chebyshev::fit(wave, 2, 5, 30), slope = series.derivative(), area = series.integral();
  for (double u = 2; u <= 5; u += 0.11) EXPECT_NEAR(slope(u), std::cos(u) * wave(u), 1e-12);
  EXPECT_NEAR(area(2), 0, 1e-15);
  const Chebyshev back = area.derivative();
  for (double u = 2; u <= 5; u += 0.11) EXPECT_NEAR(back(u), series(u), 1e-12);
  const Chebyshev cubic = Chebyshev::fit([](double u) { return u * u * u; }, 1, 3, 3).integral();
  EXPECT_NEAR(cubic(3), 20, 1e-13);
  const Chebyshev constant(0, 2, {3});
  EXPECT_EQ(constant.derivative()(1), 0);
  EXPECT_NEAR(constant.integral()(2), 6, 1e-15);
}

TEST(Chebyshev, BoundHoldsEverywhere) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> c(1 + random.below(12));
    for (double& x : c) x = random.normal();
    const Chebyshev series(-3, 4, c);
    for (int k = 0; k <= 100; ++k) EXPECT_LE(std::abs(series(-3 + 0.07 * k)), series.bound() * (1 + 1e-14));
  }
}

TEST(Chebyshev, PowerBasisIsTheSamePolynomial) {
  Random random(5);
  for (std::size_t n = 0; n <= 12; ++n) {
    std::vector<double> c(n + 1);
    for (std::size_t k = 0; k <= n; ++k) c[k] = random.normal() * std::pow(0.3, static_cast<double>(k));
    const Chebyshev series(-1, 1, c);
    const Polynomial power = series.power_basis();
    for (double x = -1; x <= 1; x += 0.1) EXPECT_NEAR(evaluate(power, x), series(x), 1e-14);
  }
}

}  // namespace
}  // namespace bahnwerk
