// Bounds against what the same formula gives along random complex directions at random places of the ball.
#include "core/numeric/majorant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

namespace bahnwerk {
namespace {

using M = Majorant<4>;
using Complex = std::complex<double>;

// What std::complex does not have.
Complex atan2(Complex y, Complex x) {
  return Complex(0, -0.5) * std::log((x + Complex(0, 1) * y) / (x - Complex(0, 1) * y));
}

/// Derivatives along a line by Cauchy's formula on a small circle, which stays in the ball.
template <class F>
void compare(F&& f, double x0, double y0, double radius, double slack) {
  const auto bound = f(M::coordinate(x0, radius), M::coordinate(y0, radius));
  EXPECT_NEAR(bound.centre(), f(Complex(x0), Complex(y0)).real(), 1e-14);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  std::array<double, 5> most{};
  double off = 0;
  for (int round = 0; round < 400; ++round) {
    std::array<Complex, 2> at, e;
    double n0 = 0, n1 = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      at[i] = {normal(random), normal(random)}, e[i] = {normal(random), round % 2 ? normal(random) : 0};
      n0 += std::norm(at[i]), n1 += std::norm(e[i]);
    }
    const double h = 0.05 * radius;
    for (std::size_t i = 0; i < 2; ++i)
      at[i] = (i == 0 ? x0 : y0) + at[i] * (radius - h) * uniform(random) / std::sqrt(n0), e[i] /= std::sqrt(n1);
    off = std::max(off, std::abs(f(at[0], at[1]) - bound.centre()));
    double factorial = 1;
    for (int n = 1; n <= 4; ++n) {
      factorial *= n;
      Complex sum;
      for (int j = 0; j < 16; ++j) {
        const Complex turn = std::polar(1.0, 2 * M_PI * j / 16);
        sum += f(at[0] + h * turn * e[0], at[1] + h * turn * e[1]) * std::pow(turn, -n);
      }
      const double size = std::abs(sum) * factorial / (16 * std::pow(h, n));
      EXPECT_LE(size, bound.derivative(static_cast<std::size_t>(n)) * (1 + 1e-6) + 1e-13 * factorial / std::pow(h, n));
      most[static_cast<std::size_t>(n)] = std::max(most[static_cast<std::size_t>(n)], size);
    }
  }
  EXPECT_LE(off, bound.off());
  EXPECT_LE(bound.derivative(1), slack * most[1]);
}

TEST(Majorant, BoundsWhatFormulasDo) {
  for (const double radius : {0.02, 0.2}) {
    compare([](auto x, auto y) { return x * y - x + y; }, 0.4, -0.7, radius, 3);
    compare([](auto x, auto y) { return (x + y) / (x * x + y * y); }, 1.4, -0.7, radius, 12);
    compare([](auto x, auto y) { return sqrt(x * x + y); }, 0.4, 1.5, radius, 3);
    compare([](auto x, auto y) { return sin(x) * cos(y + y); }, 0.4, 2.1, radius, 4);
    compare([](auto x, auto y) { return atan2(y, x); }, 1.1, 0.8, radius, 6);
    compare([](auto x, auto y) { return acos(x * y); }, 0.4, 0.8, radius, 4);
  }
}

TEST(Majorant, IsExactWhereThereIsNothingToBound) {
  const M x = M::coordinate(2, 0.5), line = M(3) * x - M(1);
  EXPECT_EQ(line.centre(), 5);
  EXPECT_EQ(line.derivative(1), 3);
  EXPECT_EQ(line.derivative(2), 0);
  EXPECT_EQ(line.off(), 1.5);
  EXPECT_EQ((-x).centre(), -2);
}

TEST(Majorant, IsInfiniteWhereASingularityMayBeReached) {
  const M near = M::coordinate(0.3, 0.4), zero(0);
  EXPECT_TRUE(std::isinf((M(1) / near).derivative(1)));
  EXPECT_TRUE(std::isinf(sqrt(near).derivative(3)));
  EXPECT_TRUE(std::isinf(acos(near + M(0.5)).derivative(1)));
  EXPECT_TRUE(std::isinf(atan2(near, near).derivative(2)));
  EXPECT_TRUE(std::isinf((sqrt(near) + M(1)).derivative(1)));
  EXPECT_EQ((sqrt(near) * zero).derivative(1), 0);  // it does not count
  EXPECT_TRUE(std::isfinite(sqrt(near + M(0.2)).derivative(4)));
}

}  // namespace
}  // namespace bahnwerk
