#include "core/base/setpoint_source.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

/// Leaves to the interface whatever it can.
class Plain final : public SetpointSource {
 public:
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return 3; }
  double cycle_time() const override { return 0.004; }
  double duration() const override { return 0.008; }
  void read(std::size_t, std::size_t, double*) const override {}

 private:
  std::vector<Column> columns_;
};

TEST(SetpointSource, UnlessItSaysOtherwiseASeriesIsOverTimeInTheMachinesOwnFrame) {
  const Plain plain;
  EXPECT_TRUE(plain.independent().time());
  EXPECT_EQ(plain.independent().unit, "s");
  EXPECT_EQ(plain.independent().step, 0.004);
  EXPECT_FALSE(plain.pose_frame());
  EXPECT_FALSE((Independent{"angle", "deg", 0.5}.time()));
}

}  // namespace
}  // namespace bahnwerk
