#include "core/redundant/coarse/coarse_alone.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/split_excess.hpp"

namespace bahnwerk {
namespace {

TEST(CoarseAlone, AStraightMoveIsThatOfTheCoarseAxis) {
  Progress progress;
  const RedundancyTask task = test::redundancy_task(test::straight(450, 0), test::md2());
  const RedundancyResult r = plan_coarse_alone(task, {}, progress);
  EXPECT_NEAR(r.head->duration(), 450.0 / 1800 + 1800.0 / 16000, 1e-8);
  EXPECT_LE(test::split_excess(task, r).limits, 0);
}

/// At 400 times, with limited jerk and without.
TEST(CoarseAlone, TheCoarseAxesDoWhatTheHeadDoesWithinTheirLimits) {
  for (const double per_second : {0.0, 150.0}) {
    CoarseFineMachine machine = test::md1();
    if (per_second > 0) machine = test::with_jerk(machine, per_second);
    const RedundancyTask task = test::redundancy_task(test::slot(60, 8, 200), machine);
    Progress progress;
    const RedundancyResult r = plan_coarse_alone(task, {}, progress);
    EXPECT_EQ(r.coarse_jerk_limited, per_second > 0);
    ASSERT_DOUBLE_EQ(r.head->duration(), r.coarse->duration());
    for (int i = 0; i <= 400; ++i) {
      const double t = r.head->duration() * i / 400;
      const MotionState x = r.head->evaluate(t), c = r.coarse->evaluate(t);
      for (std::size_t k = 0; k < machine.axes.size(); ++k) {
        const Limits& coarse = machine.axes[k].coarse;
        ASSERT_NEAR(x[0][k], c[0][k], 1e-12);
        ASSERT_NEAR(x[1][k], c[1][k], 1e-9);
        EXPECT_LE(std::abs(c[1][k]), coarse.velocity * (1 + 1e-9));
        EXPECT_LE(std::abs(c[2][k]), coarse.acceleration * (1 + 1e-9));
        EXPECT_LE(std::abs(c[3][k]), coarse.jerk * (1 + 1e-6));
      }
    }
  }
}

}  // namespace
}  // namespace bahnwerk
