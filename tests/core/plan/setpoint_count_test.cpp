#include "core/plan/setpoint_count.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

const std::vector<std::string> place{"machine", "cycle_time"};

TEST(SetpointCount, RowsAtBothEndsCount) {
  EXPECT_NO_THROW(limit_setpoints(1, 0.25, 5, place));
  EXPECT_THROW(limit_setpoints(1, 0.25, 4, place), InvalidInput);
  EXPECT_THROW(limit_setpoints(1.01, 0.25, 5, place), InvalidInput);  // the cycle that was begun
}

TEST(SetpointCount, FaultNamesTheCycleTimeAndBothNumbers) {
  try {
    limit_setpoints(10, 0.001, 100, place);
    ADD_FAILURE();
  } catch (const InvalidInput& error) {
    ASSERT_EQ(error.faults.size(), 1u);
    EXPECT_EQ(error.faults[0].place, place);
    EXPECT_EQ(error.faults[0].message, "the motion has 10001 setpoints, at most 100 are allowed");
  }
}

}  // namespace
}  // namespace bahnwerk
