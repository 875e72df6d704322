// The Illinois method: superlinear, and never outside its bracket for long.
#include "core/numeric/sign_change.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace bahnwerk {
namespace {

int steps(const std::function<double(double)>& f, double low, double high, double root) {
  SignChange bracket{low, f(low), high, f(high)};
  for (int i = 1; i <= 60; ++i) {
    const double x = bracket.next();
    EXPECT_LE(bracket.low, root);
    EXPECT_GE(bracket.high, root);
    if (std::abs(x - root) < 1e-12) return i;
    bracket.take(x, f(x));
  }
  return 61;
}

TEST(SignChange, FewStepsWherePlainSecantsInABracketStall) {
  EXPECT_EQ(steps([](double x) { return 2 * x - 1; }, 0, 1, 0.5), 1);
  EXPECT_LE(steps([](double x) { return std::exp(x) - 2; }, 0, 3, std::log(2)), 10);
  EXPECT_LE(steps([](double x) { return 2 - std::exp(x); }, 0, 3, std::log(2)), 10);
  EXPECT_LE(steps([](double x) { return x * x * x * x * x - 1e-5; }, 0, 1, 0.1), 40);
}

TEST(SignChange, KeepsTheSideOfEveryPlace) {
  SignChange bracket{0, -1, 4, 2};
  bracket.take(1, -0.5);
  EXPECT_EQ(bracket.low, 1);
  EXPECT_EQ(bracket.f_high, 2);
  bracket.take(2, -0.25);
  EXPECT_EQ(bracket.low, 2);
  EXPECT_EQ(bracket.f_high, 1);  // it has stayed twice
  bracket.take(3, 0.5);
  EXPECT_EQ(bracket.high, 3);
  EXPECT_EQ(bracket.f_low, -0.25);
  EXPECT_TRUE(bracket.holds(2.5));
  EXPECT_FALSE(bracket.holds(3));
  EXPECT_EQ(bracket.middle(), 2.5);
}

}  // namespace
}  // namespace bahnwerk
