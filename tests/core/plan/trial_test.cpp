#include "core/plan/trial.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(Trial, ReturnsThePlanOrWhyThereIsNone) {
  const auto found = trial([] { return 3; });
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, 3);
  const auto none = trial([]() -> int { throw Infeasible("no way"); });
  ASSERT_FALSE(none);
  EXPECT_EQ(none.reason(), "no way");
}

TEST(Trial, DoesNotKeepAJobFromStopping) {
  EXPECT_THROW(trial([]() -> int { throw Stopped(StopReason::cancelled); }), Stopped);
  EXPECT_THROW(trial([]() -> int { throw std::logic_error("a fault of the program"); }), std::logic_error);
}

}  // namespace
}  // namespace bahnwerk
