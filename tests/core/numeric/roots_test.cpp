#include "core/numeric/roots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

TEST(NewtonBisect, FindsTheRootToTheTolerance) {
  const auto f = [](double x) { return std::pair{std::cos(x), -std::sin(x)}; };
  EXPECT_NEAR(newton_bisect(f, 0.1, 3, 0.1, 1e-15), std::numbers::pi / 2, 1e-15);
}

TEST(NewtonBisect, StaysInTheBracketWhereNewtonWouldLeaveIt) {
  int calls = 0;
  const auto f = [&](double x) {  // Newton alone diverges from |x| > 1.39
    ++calls;
    EXPECT_LE(std::abs(x), 40);
    return std::pair{std::atan(x), 1 / (1 + x * x)};
  };
  EXPECT_NEAR(newton_bisect(f, -40, 30, 25, 1e-14), 0, 1e-14);
  EXPECT_LT(calls, 60);
}

TEST(NewtonBisect, AcceptsARootAtTheEnd) {
  const auto f = [](double x) { return std::pair{x, 1.0}; };
  EXPECT_EQ(newton_bisect(f, 0, 1, 0.5, 1e-15), 0);
  EXPECT_NEAR(newton_bisect(f, -1, 0, -0.5, 1e-15), 0, 1e-15);
}

TEST(Brent, RandomCubics) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double root = random.uniform(-1, 1), b = random.uniform(0, 1), c = random.uniform(0, 2);
    int calls = 0;
    const auto f = [&](double x) {
      ++calls;
      const double y = x - root;
      return y * (c + b * y * y) + y * 1e-3;
    };
    EXPECT_NEAR(brent(f, -1.5, 1.5, 1e-14), root, 1e-13);
    EXPECT_LT(calls, 60);
  }
}

TEST(Brent, FindsAJump) {
  EXPECT_NEAR(brent([](double x) { return x < 0.3 ? -1.0 : 1.0; }, 0, 1, 1e-12), 0.3, 2e-12);
}

}  // namespace
}  // namespace bahnwerk
