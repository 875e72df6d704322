#include "core/base/infeasible_at.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(InfeasibleAt, IsInfeasibleWithPlacesAndItsOwnText) {
  try {
    throw InfeasibleAt("no motion", {{{"machine", "axes"}, "too slow"}});
  } catch (const Infeasible& error) {
    EXPECT_STREQ(error.what(), "no motion");
    const auto* placed = dynamic_cast<const InfeasibleAt*>(&error);
    ASSERT_NE(placed, nullptr);
    EXPECT_EQ(placed->faults.front().place, (std::vector<std::string>{"machine", "axes"}));
    EXPECT_EQ(placed->faults.front().message, "too slow");
  }
}

}  // namespace
}  // namespace bahnwerk
