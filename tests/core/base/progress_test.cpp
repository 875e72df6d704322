#include "core/base/progress.hpp"

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

TEST(Progress, OfNobodyReportsNothing) { EXPECT_NO_THROW(Progress().part(0, 0.5).named("x").report("inner", 0.5)); }

TEST(Progress, PartsMapFractionsToTheirRange) {
  Last last;
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
  Last last;
  const Progress outer = Progress(last).named("outer");
  outer.report("inner", 0);
  EXPECT_EQ(last.stage, "outer");
  outer.part(0, 1).named("within").report("inner", 0);
  EXPECT_EQ(last.stage, "outer");
}

TEST(Progress, AWishToStopPassesThrough) {
  Last last;
  last.stop = true;
  EXPECT_THROW(Progress(last).part(0, 0.5).named("split").report("inner", 0.5), Stopped);
}

}  // namespace
}  // namespace bahnwerk
