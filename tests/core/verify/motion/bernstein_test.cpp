#include "core/verify/motion/bernstein.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace bahnwerk::verify {
namespace {

TEST(BernsteinForm, APolynomialOfTimeIsReproducedAndEnclosed) {
  const Polynomial p{2, -3, 0.5, 4, -1};
  const double duration = 1.7, offset = 0.25;
  Bernstein b{};
  ASSERT_EQ(bernstein(p, duration, offset, b), 5u);
  EXPECT_DOUBLE_EQ(b[0], 2.25);
  double low = b[0], high = b[0];
  for (std::size_t i = 1; i < 5; ++i) low = std::min(low, b[i]), high = std::max(high, b[i]);
  for (int i = 0; i <= 20; ++i) {
    const double x = i / 20.0, t = duration * x;
    double value = offset, power = 1;
    for (std::size_t k = 0; k < 5; ++k, power *= t) value += p[k] * power;
    const double weights[] = {std::pow(1 - x, 4), 4 * x * std::pow(1 - x, 3), 6 * x * x * (1 - x) * (1 - x),
                              4 * x * x * x * (1 - x), x * x * x * x};
    double sum = 0;
    for (std::size_t k = 0; k < 5; ++k) sum += weights[k] * b[k];
    EXPECT_NEAR(sum, value, 1e-12);
    EXPECT_LE(low, value + 1e-12);
    EXPECT_GE(high, value - 1e-12);
  }
}

TEST(BernsteinForm, AConstantHasOneCoefficient) {
  Bernstein b{};
  EXPECT_EQ(bernstein({}, 3, 7, b), 1u);
  EXPECT_EQ(b[0], 7);
}

}  // namespace
}  // namespace bahnwerk::verify
