#include "core/redundant/redundancy.hpp"

#include <gtest/gtest.h>

#include <set>

namespace bahnwerk {
namespace {

/// A table of plans that gave way tells them apart by name.
TEST(Redundancy, EveryPlannerHasANameOfItsOwn) {
  std::set<std::string> names{coarse_axes_alone, timed_again};
  for (const auto& method : redundancy_methods) names.insert(planner_name(method.value));
  EXPECT_EQ(names.size(), std::size(redundancy_methods) + 2);
  EXPECT_EQ(planner_name(RedundancyMethod::lag_compensation), "lag_compensation");
}

}  // namespace
}  // namespace bahnwerk
