#include "core/redundant/iterative/split_peaks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

/// A circle at constant feed between rests, and a coarse axis that rises and falls.
TEST(SplitPeaks, BoundWhatDenseSamplesShow) {
  const JointTask task = test::joint_task(test::holes(2, 1, 15, 4), test::md2());
  const Machine machine = summed(task.machine);
  Progress progress;
  const PathMotion head(
      task.path, plan_acceleration_limited(PathTask{*task.path, machine, task.feeds, task.rests}, {}, progress).law);
  const double T = head.duration();
  TimeSpline coarse;
  coarse.append(T / 3, {0, 0, 40, 300, -200, 100});
  coarse.append(T, coarse.from(0, T / 3));
  HeadCellOptions o;
  o.longest = 1e-3;
  for (const AxisLimits& axis : machine.axes) {
    o.held.push_back(axis);
    o.acceleration_change.push_back(1200);
    o.jerk_change.push_back(unlimited);
    o.jerk_range.push_back(unlimited);
  }
  ProgressScope scope(progress, "test");
  const HeadCells cells = head_cells(head, o, scope);
  const std::size_t n = task.path->size();
  HeadSamples samples;
  samples.axes.resize(2);
  std::size_t piece = 0;
  for (int i = 0; i <= 20000; ++i) {
    const double t = T * i / 20000;
    const MotionState x = head.evaluate(t, piece);
    samples.times.push_back(t);
    samples.segments.push_back(head.law().pieces()[piece].segment);
    for (std::size_t k = 0; k < 2; ++k) samples.axes[k].push_back({x[0][k], x[1][k], x[2][k], x[3][k]});
  }
  for (std::size_t k = 0; k < 2; ++k) {
    CellsBegin at;
    const std::vector<SplitPeaks> bound = split_peaks(cells, head.law(), k, coarse, {0, n}, at),
                                  seen = sampled_peaks(samples, k, coarse, {0, n});
    ASSERT_EQ(bound.size(), n);
    for (std::size_t b = 0; b < n; ++b) {
      SCOPED_TRACE(b);
      const auto check = [](double upper, double value, double slack) {
        EXPECT_GE(upper, value * (1 - 1e-9));
        EXPECT_LE(upper, value + slack);
      };
      check(bound[b].offset, seen[b].offset, 0.05);
      check(bound[b].coarse_velocity, seen[b].coarse_velocity, 2);
      check(bound[b].coarse_acceleration, seen[b].coarse_acceleration, 20);
      check(bound[b].fine_velocity, seen[b].fine_velocity, 4);
      check(bound[b].fine_acceleration, seen[b].fine_acceleration, 2000);
    }
  }
}

}  // namespace
}  // namespace bahnwerk
