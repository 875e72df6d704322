#include "core/plan/winding/onward_progress.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/core/base/last_report.hpp"

namespace bahnwerk {
namespace {

TEST(OnwardProgress, ARepeatedStepReportsTheLargestFractionBefore) {
  test::LastReport last;
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
