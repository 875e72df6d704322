// Links between turns, chosen by the time that the motion takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "tests/core/plan/winding/winding_plans.hpp"

namespace bahnwerk {
namespace {

TEST(WindingPlan, LinksByTimeAreTheFastest) {
  for (const bool stator : {true, false}) {
    const auto with = [&](bool by_time, LinkObjective objective) {
      WindingRequest r = stator ? stator_request(2) : rotor_request(2);
      r.links.objective = objective;
      r.minimum_time = by_time;
      return planned(r);
    };
    const WindingPlan quick = with(true, LinkObjective::curvature);
    expect_verified(quick, "by time");
    const double smooth = with(false, LinkObjective::curvature).motion.duration,
                 substitute = with(false, LinkObjective::control_distance).motion.duration;
    EXPECT_LT(quick.motion.duration, 0.98 * std::min(smooth, substitute)) << stator;
    ASSERT_TRUE(quick.link_times);
    EXPECT_EQ(quick.link_times->taken, LinkChoice::minimum_time);
    EXPECT_NEAR(quick.link_times->curvature, smooth, 2e-3 * smooth);
    EXPECT_NEAR(quick.link_times->control_distance, substitute, 2e-3 * substitute);
    EXPECT_NEAR(quick.link_times->minimum_time, quick.motion.duration, 2e-3 * smooth);
  }
}

// Where pieces join with a step of the curvature an axis may step by its jerk times a cycle: the shorter the cycle, the
// longer the motion.
TEST(WindingPlan, LinksAreTimedByTheCyclesOfTheSetpoints) {
  std::vector<double> times;
  for (const double cycle : {0.0005, 0.008}) {
    WindingRequest r = rotor_request(1);
    r.links.continuity = 1, r.cycle_time = cycle;
    const double smooth = planned(r).motion.duration;
    r.minimum_time = true;
    const WindingPlan quick = planned(r);
    ASSERT_TRUE(quick.link_times);
    EXPECT_NEAR(quick.link_times->curvature, smooth, 2e-3 * smooth);
    times.push_back(quick.link_times->curvature);
  }
  EXPECT_GT(times[0], 1.02 * times[1]);
}

// Beside a high post the quickest links cut the corner. Whether they are then too near hangs on the last digits of
// their search, so several distances are asked for.
TEST(WindingPlan, LinksByTimeComeNoNearerThanIsAllowed) {
  WindingRequest r = stator_request(1);
  r.model.pivot_limit = 10 * std::numbers::pi / 180;
  r.needle.width = 1.6;
  r.tool.width = 2.5, r.tool.height = 40;
  r.minimum_time = true;
  int too_near = 0;
  for (const double least : {0.25, 0.3, 0.32, 0.34, 0.36}) {
    SCOPED_TRACE(least);
    r.least_clearance = least;
    const WindingPlan p = planned(r);
    expect_verified(p, "by time, beside a post");
    ASSERT_TRUE(p.link_times);
    EXPECT_LT(p.link_times->minimum_time, p.link_times->curvature);
    EXPECT_GE(p.clearance.minimum, least);
    too_near += p.link_times->taken != LinkChoice::minimum_time;
  }
  EXPECT_GE(too_near, 1);
}

}  // namespace
}  // namespace bahnwerk
