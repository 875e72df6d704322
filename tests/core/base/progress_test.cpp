#include "core/base/progress.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/core/base/last_report.hpp"

namespace bahnwerk {
namespace {

TEST(Progress, OfNobodyReportsNothing) { EXPECT_NO_THROW(Progress().part(0, 0.5).named("x").report("inner", 0.5)); }

TEST(Progress, PartsMapFractionsToTheirRange) {
  test::LastReport last;
  const Progress part = Progress(last).part(0.25, 0.75);
  part.report("inner", 0);
  EXPECT_EQ(last.stage, "inner");
  EXPECT_DOUBLE_EQ(last.fraction, 0.25);
  part.report("inner", 0.5, "half");
  EXPECT_DOUBLE_EQ(last.fraction, 0.5);
  EXPECT_EQ(last.message, "half");
  part.part(0.5, 1).report("inner", 0.5);
  EXPECT_DOUBLE_EQ(last.fraction, 0.625);
  part.part(1, 1).report("inner", 0.3);
  EXPECT_DOUBLE_EQ(last.fraction, 0.75);
}

TEST(Progress, TheOuterNameStandsBeforeInnerOnes) {
  test::LastReport last;
  const Progress outer = Progress(last).named("outer");
  outer.report("inner", 0);
  EXPECT_EQ(last.stage, "outer");
  outer.part(0, 1).named("within").report("inner", 0);
  EXPECT_EQ(last.stage, "outer");
}

TEST(Progress, AWishToStopPassesThrough) {
  test::LastReport last;
  last.stop = true;
  EXPECT_THROW(Progress(last).part(0, 0.5).named("split").report("inner", 0.5), Stopped);
}

}  // namespace
}  // namespace bahnwerk
