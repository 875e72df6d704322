#include "core/base/unreachable_at.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(UnreachableAt, IsAnUnreachablePoseWithItsCause) {
  const UnreachablePose pose("too far", 12, {1, 2, 3, 0.5, 0.25});
  const UnreachableAt placed("bent too far", pose, {"pull", "bend_radius"});
  const UnreachablePose& error = placed;
  EXPECT_STREQ(error.what(), "bent too far");
  EXPECT_EQ(error.path_length, 12);
  EXPECT_EQ(error.pose, pose.pose);
  EXPECT_EQ(placed.place, (std::vector<std::string>{"pull", "bend_radius"}));
}

}  // namespace
}  // namespace bahnwerk
