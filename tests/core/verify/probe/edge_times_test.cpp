#include "core/verify/probe/edge_times.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk {
namespace {

TEST(EdgeTimes, ClosedFormsPerLimit) {
  ProbeProblem p;
  p.given = {{0, 0}, {3, 4}};
  p.speed = 10;
  for (const char* name : {"x", "y"}) {
    AxisLimits axis(name, unlimited, 1e9, 1e12);
    axis.snap = 1e15;
    p.machine.axes.push_back(axis);
  }
  merge_points(p);
  EXPECT_NEAR(least_time(p, {3, 4}, {}, 0), 0.5, 1e-10);
  EXPECT_NEAR(least_time(p, {3, 4}, {}, 1), 0.4, 1e-10);
  p.machine.axes[1].snap = 100;
  EXPECT_NEAR(least_time(p, {3, 4}, {true, true}, 0), std::pow(384 * 4 / 100.0, 0.25), 1e-10);
  EXPECT_NEAR(least_time(p, {3, 4}, {true, false}, 0), std::pow(24 * 4 / 100.0, 0.25), 1e-10);
  p.machine.axes[1].jerk = 1;
  EXPECT_NEAR(least_time(p, {3, 4}, {true, true}, 0), std::cbrt(128), 1e-10);
  p.machine.axes[0].acceleration = 0.1;
  EXPECT_NEAR(least_time(p, {3, 4}, {false, true}, 0), std::sqrt(60), 1e-10);
}

}  // namespace
}  // namespace bahnwerk
