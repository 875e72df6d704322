#include "core/machine/limits.hpp"

#include <gtest/gtest.h>

#include "core/machine/machine.hpp"

namespace bahnwerk {
namespace {

TEST(Limits, AreOnePerDerivative) {
  Limits limits{1, 2, 3, 4};
  for (int order = 1; order <= Limits::highest_order; ++order) {
    EXPECT_EQ(limits.of(order), order);
    limits.of(order) *= 10;
  }
  EXPECT_EQ(limits.velocity, 10);
  EXPECT_EQ(limits.acceleration, 20);
  EXPECT_EQ(limits.jerk, 30);
  EXPECT_EQ(limits.snap, 40);
}

TEST(Limits, AMotionKeepsThoseOfEveryAxisThatItMoves) {
  Limits along{100, unlimited, 5000};
  along.lower_to({60, 800, 5000, 9e4}, 0.5);
  along.lower_to({90, 900});
  EXPECT_EQ(along.velocity, 90);
  EXPECT_EQ(along.acceleration, 900);
  EXPECT_EQ(along.jerk, 5000);
  EXPECT_EQ(along.snap, 18e4);
  along.scale(2);
  EXPECT_EQ(along.velocity, 180);
  EXPECT_EQ(along.acceleration, 1800);
  EXPECT_EQ(along.jerk, 1e4);
  EXPECT_EQ(along.snap, 36e4);
}

TEST(Limits, RangesMayBeOpenAtOneEnd) {
  Limits limits;
  EXPECT_FALSE(limits.has_range());
  limits.lowest = -5;
  EXPECT_TRUE(limits.has_range());
  limits = {};
  limits.highest = 5;
  EXPECT_TRUE(limits.has_range());
}

TEST(AxisLimits, TakeAllLimitsAndAName) {
  Limits limits{1, 2, 3, 4, -5, 6};
  const AxisLimits axis("q", limits);
  EXPECT_EQ(axis.name, "q");
  EXPECT_EQ(axis.snap, 4);
  EXPECT_EQ(axis.lowest, -5);
}

}  // namespace
}  // namespace bahnwerk
