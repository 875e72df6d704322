#include "core/redundant/head/slower_sections.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/redundant/chain/chain_solver.hpp"
#include "core/redundant/head/following.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk {
namespace {

/// A long move between short ones, some of which give the coarse axis time to be where it has to be. Feeds only fall,
/// the long one's among them, and not below √(S·A_c), a speed at which the coarse axis can always follow.
TEST(SlowerSections, FeedsFallUntilTheCoarseAxisCanFollow) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::position, unlimited);
  for (const double x : {5.0, 0.0, 5.0, 600.0, 605.0, 600.0}) b.line({x, 0, 0});
  const JointTask task = test::joint_task(b.finish(), test::md2());
  const CoarseFineAxis& axis = task.machine.axes[0];
  const Machine machine = head_limits(task.machine);
  Progress progress;
  SectionLimits section_limits{task.feeds, {}};
  double duration = 0;
  for (int round = 0; round < 40; ++round) {
    const TimeLaw law =
        plan_acceleration_limited(PathTask{*task.path, machine, section_limits.feeds, task.rests}, {}, progress).law;
    EXPECT_GT(law.duration(), duration);
    duration = law.duration();
    const PathMotion head(task.path, law);
    HeadCellOptions o;
    for (const AxisLimits& limits : machine.axes) {
      o.held.push_back(limits);
      o.acceleration_change.push_back(3000);
      o.jerk_change.push_back(unlimited);
      o.jerk_range.push_back(unlimited);
    }
    const HeadCells cells = head_cells(head, o, silent_scope());
    const Chain<2> chain = following<2>(cells, 0, axis).value();
    const ChainSolution<2> s = solve(chain, {});
    if (s.excess <= 1e-7) {
      ASSERT_GT(round, 1);
      EXPECT_GT(section_limits.feeds[3], std::sqrt(20.0 * 16000));
      EXPECT_LT(section_limits.feeds[3], 3800);
      return;
    }
    const std::vector<double> before = section_limits.feeds;
    for (const auto& c : clusters(chain, s, 1e-7))
      lower_section_limits<2>(law, cells, {0, axis, c}, 1.25, section_limits);
    EXPECT_NE(section_limits.feeds, before);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LE(section_limits.feeds[i], before[i]);
  }
  FAIL() << "still too fast";
}

}  // namespace
}  // namespace bahnwerk
