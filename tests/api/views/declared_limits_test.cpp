#include "api/views/declared_limits.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::api {
namespace {

TEST(DeclaredLimitsTest, AxesHaveTheirFiniteLimitsByOrder) {
  Machine machine;
  machine.axes = {{"x", 100, 2000, 30000}, {"c", 5}};
  machine.axes[1].unit = "deg";
  machine.axes[1].snap = 7;
  DeclaredLimits list;
  declare_axes(list, machine);
  ASSERT_EQ(list.size(), 5U);
  EXPECT_EQ(list[0].name, "velocity x");
  EXPECT_EQ(list[1].name, "velocity c");
  EXPECT_EQ(list[1].unit, "deg/s");
  EXPECT_EQ(list[2].unit, "mm/s²");
  EXPECT_EQ(list[3].name, "jerk x");
  EXPECT_EQ(list[4].name, "snap c");
  EXPECT_EQ(list[4].permitted.highest, 7);
}

TEST(DeclaredLimitsTest, PathLimitsAreFeedAccelerationAndJerk) {
  DeclaredLimits list;
  declare_path(list, Limits{200, unlimited, 5000});
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].name, "feed");
  EXPECT_EQ(list[1].name, "path jerk");
  EXPECT_EQ(list[1].unit, "mm/s³");
}

TEST(DeclaredLimitsTest, EqualFeedsOfConsecutiveBlocksAreOneStep) {
  DeclaredLimits list;
  declare_feeds(list, {unlimited, 400, 400, 50, unlimited});
  ASSERT_EQ(list.size(), 1U);
  ASSERT_EQ(list[0].steps.size(), 4U);
  EXPECT_EQ(list[0].steps[2].from, 3);
  EXPECT_EQ(list[0].steps[2].permitted.highest, 50);
  EXPECT_TRUE(list[0].steps[3].permitted.none());
}

TEST(DeclaredLimitsTest, OneFeedForAllBlocksIsAValueAndNoneIsNoLimit) {
  DeclaredLimits list;
  declare_feeds(list, {unlimited, unlimited});
  declare_feeds(list, {});
  EXPECT_TRUE(list.empty());
  declare_feeds(list, {400, 400});
  ASSERT_EQ(list.size(), 1U);
  EXPECT_TRUE(list[0].key.empty());
  EXPECT_EQ(list[0].permitted.highest, 400);
}

}  // namespace
}  // namespace bahnwerk::api
