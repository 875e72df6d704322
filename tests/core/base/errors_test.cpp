#include "core/base/errors.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(Errors, AllAreCaughtAsOneAndSayTheFirstFault) {
  const auto text = [](const auto& error) {
    try {
      throw error;
    } catch (const PlanningError& caught) {
      return std::string(caught.what());
    }
  };
  EXPECT_EQ(text(InvalidInput({{{"a"}, "first"}, {{"b"}, "second"}})), "first");
  EXPECT_EQ(text(InvalidInput({})), "invalid input") << "no fault is no crash";
  EXPECT_EQ(text(Infeasible("too short")), "too short");
  EXPECT_EQ(text(UnreachablePose("far away", 3)), "far away");
  EXPECT_EQ(text(ToleranceUnreachable("too fine", 0.1)), "too fine");
  EXPECT_EQ(text(Stopped(StopReason::deadline)), "stopped");
}

}  // namespace
}  // namespace bahnwerk
