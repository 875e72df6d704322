#include "core/cam/bernstein.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/core/cases.hpp"

namespace bahnwerk::cam {
namespace {

double sampled(const std::vector<double>& b, double sign) {
  double most = -1e300;
  for (int k = 0; k <= 4000; ++k) most = std::max(most, sign * bernstein_value(b, k / 4000.0));
  return most;
}

TEST(Bernstein, ExtremesEncloseSamplesAndAreReached) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int i = 0; i < testing::cases(300); ++i) {
    std::vector<double> b(1 + random() % 22);
    for (double& c : b) c = value(random);
    BernsteinExtremes found{1e300, -1e300};
    take_extremes(b, found);
    const double high = sampled(b, 1), low = -sampled(b, -1);
    EXPECT_GE(found.high, high - 1e-15);
    EXPECT_LE(found.low, low + 1e-15);
    EXPECT_LE(found.high, high + 1e-4);
    EXPECT_GE(found.low, low - 1e-4);
    EXPECT_NEAR(bernstein_value(b, found.high_at), found.high, 1e-14);
    EXPECT_NEAR(bernstein_value(b, found.low_at), found.low, 1e-14);
  }
}

TEST(Bernstein, KnownExtremesThatNothingExceedsStay) {
  BernsteinExtremes known{-2, 2};
  take_extremes(std::vector<double>{0, 1, -1, 0}, known);
  EXPECT_EQ(known.high, 2);
  EXPECT_EQ(known.high_at, -1);
}

/// The velocity of a symmetric rise between rests: its own derivative vanishes at both ends, and next to the middle.
TEST(Bernstein, AnExtremeBetweenEndsWithoutSlopeIsFound) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(0.1, 1);
  for (int i = 0; i < 200; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1, low = sign * value(random), high = low + sign * value(random);
    const double other = std::nextafter(low, i % 4 < 2 ? 2.0 : -2.0);
    const std::vector<double> b{0, 0, low, high, i % 3 == 0 ? low : other, 0, 0};
    BernsteinExtremes found{0, 0};
    take_extremes(b, found);
    EXPECT_NEAR(sign > 0 ? found.high : found.low, bernstein_value(b, 0.5), 1e-14);
  }
}

TEST(Bernstein, APolynomialThatIsNearlyConstantHasItsValue) {
  std::vector<double> b(22, 3.0);
  b[7] += 4e-16, b[11] -= 4e-16;
  BernsteinExtremes found{1e300, -1e300};
  take_extremes(b, found);
  EXPECT_NEAR(found.high, 3, 1e-14);
}

TEST(Bernstein, SplitAndRaisedPartsAreTheSamePolynomial) {
  const std::vector<double> b{0, 1, -2, 5};
  BernsteinArray left{}, right{}, raised{};
  bernstein_split(b, 0.3, left.data(), right.data());
  std::copy(b.begin(), b.end(), raised.begin());
  bernstein_raise(raised.data(), 3, 9);
  for (const double x : {0.0, 0.25, 0.6, 1.0}) {
    EXPECT_NEAR(bernstein_value({left.data(), 4}, x), bernstein_value(b, 0.3 * x), 1e-15);
    EXPECT_NEAR(bernstein_value({right.data(), 4}, x), bernstein_value(b, 0.3 + 0.7 * x), 1e-15);
    EXPECT_NEAR(bernstein_value({raised.data(), 10}, x), bernstein_value(b, x), 1e-14);
  }
}

}  // namespace
}  // namespace bahnwerk::cam
