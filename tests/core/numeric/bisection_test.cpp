#include "core/numeric/bisection.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk {
namespace {

TEST(Bisection, EnclosesThePlaceToTheWidth) {
  for (const double place : {0.0001, 0.7, 3.99}) {
    const Bisection found = bisect(0, 4, 1e-6, 100, [&](double x) { return x < place; });
    EXPECT_LE(found.low, place);
    EXPECT_GE(found.high, place);
    EXPECT_LE(found.high - found.low, 1e-6);
    EXPECT_GT(found.high - found.low, 4e-7);
  }
}

TEST(Bisection, WithoutAWidthItEndsBetweenNeighbouringNumbers) {
  const Bisection found = bisect(1, 2, 0, 100, [](double x) { return x * x < 2; });
  EXPECT_LT(found.low * found.low, 2);
  EXPECT_LE(found.high - found.low, std::nextafter(found.low, 2) - found.low);
}

TEST(Bisection, TakesNoMoreStepsThanAsked) {
  int steps = 0;
  const Bisection found = bisect(0, 1, 0, 10, [&](double) { return ++steps, true; });
  EXPECT_EQ(steps, 10);
  EXPECT_EQ(found.low, 1 - std::ldexp(1, -10));
  EXPECT_EQ(found.high, 1);
}

}  // namespace
}  // namespace bahnwerk
