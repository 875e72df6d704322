#include "core/plan/winding/onward_progress.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/base/errors.hpp"

namespace bahnwerk {
namespace {

struct Last final : ProgressSink {
  void report(std::string_view name, double value, std::string_view text) override {
    stage = name, fraction = value, message = text;
    if (stop) throw Stopped(StopReason::cancelled);
  }
  std::string stage, message;
  double fraction = -1;
  bool stop = false;
};

TEST(OnwardProgress, ARepeatedStepReportsTheLargestFractionBefore) {
  Last last;
  OnwardProgress onward(last);
  onward.report("link", 0.4);
  onward.report("support points", 0.1, "again");
  EXPECT_EQ(last.stage, "support points");
  EXPECT_EQ(last.message, "again");
  EXPECT_DOUBLE_EQ(last.fraction, 0.4);
  onward.report("link", 0.5);
  EXPECT_DOUBLE_EQ(last.fraction, 0.5);
  last.stop = true;
  EXPECT_THROW(onward.report("link", 0.2), Stopped);
}

}  // namespace
}  // namespace bahnwerk
