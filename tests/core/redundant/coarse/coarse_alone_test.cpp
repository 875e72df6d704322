#include "core/redundant/coarse/coarse_alone.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/redundant/methods/method_table.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/frames.hpp"
#include "tests/core/redundant/split_excess.hpp"

namespace bahnwerk {
namespace {

TEST(CoarseAlone, AStraightMoveIsThatOfTheCoarseAxis) {
  SilentProgress progress;
  const RedundancyTask task = test::redundancy_task(test::straight(450, 0), test::md2());
  const RedundancyResult r = plan_coarse_alone(task, {}, progress, 0);
  EXPECT_NEAR(r.head->duration(), 450.0 / 1800 + 1800.0 / 16000, 1e-8);
  EXPECT_LE(test::split_excess(task, r).limits, 0);
}

/// A filter whose reference has to slow down for one long move is slower than the gantry by itself.
TEST(CoarseAlone, ASlowerMotionOfAMethodGivesWayToIt) {
  SilentProgress progress;
  const RedundancyTask task = test::redundancy_task(test::framed(2, {}), test::md2());
  RedundancyOptions options;
  for (const auto& method : redundancy_methods) {
    SCOPED_TRACE(method.name);
    options.method = method.value;
    const RedundancyResult own = redundancy_row(method.value).plan(task, options, progress, 0, 1),
                           alone = plan_coarse_alone(task, options, progress, 0),
                           r = plan_redundant(task, options, progress);
    EXPECT_LE(r.head->duration(), alone.head->duration() * (1 + 1e-9));
    const bool slower = own.head->duration() > alone.head->duration() * (1 + 1e-9);
    EXPECT_EQ(r.gave_way.size(), own.gave_way.size() + slower);
    EXPECT_EQ(slower, method.value == RedundancyMethod::filter || method.value == RedundancyMethod::lag_compensation);
    EXPECT_LE(test::split_excess(task, r).limits, 1e-4);
    if (!slower) continue;
    const GaveWay& row = r.gave_way.back();
    EXPECT_EQ(row.planner, method.name);
    EXPECT_EQ(row.reason, GivingWay::slower);
    EXPECT_EQ(row.duration, own.head->duration());
    EXPECT_EQ(row.used, coarse_axes_alone);
    EXPECT_EQ(row.used_duration, r.head->duration());
  }
}

}  // namespace
}  // namespace bahnwerk
