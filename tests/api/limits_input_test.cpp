#include "api/limits_input.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bahnwerk::api {
namespace {

using nlohmann::json;

TEST(LimitsInput, EveryOrderIsRead) {
  const Limits limits = read_limits(
      json::parse(R"({"velocity":180,"acceleration":3600,"jerk":7200,"snap":90000,"range":[-90,270],"stroke":4})"),
      0.5);
  EXPECT_EQ(limits.velocity, 90);
  EXPECT_EQ(limits.acceleration, 1800);
  EXPECT_EQ(limits.jerk, 3600);
  EXPECT_EQ(limits.snap, 45000);
  EXPECT_EQ(limits.lowest, -45);
  EXPECT_EQ(limits.highest, 135);
}

TEST(LimitsInput, MissingLimitsAreInfinite) {
  const Limits limits = read_limits(json::parse(R"({"velocity":3,"jerk":null})"));
  EXPECT_EQ(limits.velocity, 3);
  for (int order = 2; order <= Limits::highest_order; ++order) EXPECT_EQ(limits.of(order), unlimited);
  EXPECT_FALSE(limits.has_range());
}

TEST(LimitsInput, MissingMembersKeepTheirValues) {
  Limits limits{1, 2, 3, 4};
  take_limits(json::parse(R"({"acceleration":7,"velocity":null})"), limits);
  EXPECT_EQ(limits.velocity, 1);
  EXPECT_EQ(limits.acceleration, 7);
  EXPECT_EQ(limits.snap, 4);
}

}  // namespace
}  // namespace bahnwerk::api
