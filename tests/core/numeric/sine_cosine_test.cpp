// Against the C library's, in long double, all round and next to the multiples of π/2 and π/4.
#include "core/numeric/sine_cosine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace bahnwerk {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon(), pi = std::numbers::pi;

double relative(double found, long double expected) {
  return expected == 0 ? std::abs(found) : static_cast<double>(std::abs(found - expected) / std::abs(expected));
}

void compare(double angle) {
  const auto [s, c] = sine_cosine(angle);
  EXPECT_LE(relative(s, std::sin(static_cast<long double>(angle))), epsilon) << angle;
  EXPECT_LE(relative(c, std::cos(static_cast<long double>(angle))), epsilon) << angle;
}

TEST(SineCosine, WithinTwoUnitsInTheLastPlace) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 100'000; ++i)
    for (const double farthest : {0.01, 1.0, 10.0, 1e3, 9.9e4}) compare(farthest * uniform(random));
  for (int quarters = -4000; quarters <= 4000; ++quarters)
    for (const double off : {0.0, 1e-15, -1e-12, 1e-9, -1e-5, pi / 4, pi / 4 + 1e-15, pi / 4 - 1e-15})
      compare(quarters * (pi / 2) + off);
}

TEST(SineCosine, ExactAtZeroAndTheSameBackwards) {
  const auto [s, c] = sine_cosine(0.0);
  EXPECT_EQ(s, 0);
  EXPECT_EQ(c, 1);
  for (const double angle : {1e-300, 0.3, 1.0, 2.0, 3.0, 5.0, 77.0}) {
    EXPECT_EQ(sine_cosine(-angle).sine, -sine_cosine(angle).sine);
    EXPECT_EQ(sine_cosine(-angle).cosine, sine_cosine(angle).cosine);
  }
}

TEST(SineCosine, LargeAnglesAndNoNumbersAreTheLibrarys) {
  for (const double angle : {1e5, -3e7, 1e300}) {
    EXPECT_EQ(sine_cosine(angle).sine, std::sin(angle));
    EXPECT_EQ(sine_cosine(angle).cosine, std::cos(angle));
  }
  for (const double angle : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(std::isnan(sine_cosine(angle).sine));
    EXPECT_TRUE(std::isnan(sine_cosine(angle).cosine));
  }
}

TEST(DirectionAngle, WithinTwoUnitsInTheLastPlace) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1), decades(-12, 12);
  double worst = 0;
  for (int i = 0; i < 300'000; ++i) {
    const double y = uniform(random), x = i % 2 == 0 ? uniform(random) : y * std::pow(10, decades(random)),
                 size = std::pow(10, decades(random));
    for (const double sign : {1.0, -1.0})
      worst = std::max(
          worst, relative(direction_angle(sign * size * y, size * x),
                          std::atan2(static_cast<long double>(sign * size * y), static_cast<long double>(size * x))));
  }
  EXPECT_LE(worst, 2 * epsilon);
}

TEST(DirectionAngle, AlongTheAxes) {
  for (const double size : {1e-300, 1.0, 1e300}) {
    EXPECT_EQ(direction_angle(0, size), 0);
    EXPECT_EQ(direction_angle(0, -size), pi);
    EXPECT_EQ(direction_angle(-0.0, -size), -pi);
    EXPECT_EQ(direction_angle(size, 0), pi / 2);
    EXPECT_EQ(direction_angle(-size, 0), -pi / 2);
    EXPECT_EQ(direction_angle(size, size), pi / 4);
    EXPECT_EQ(direction_angle(-size, -size), -3 * pi / 4);
  }
  EXPECT_TRUE(std::isnan(direction_angle(0, 0)));
}

}  // namespace
}  // namespace bahnwerk
