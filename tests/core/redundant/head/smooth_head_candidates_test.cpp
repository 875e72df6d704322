#include "core/redundant/head/smooth_head_candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

constexpr double corner_angle = 1e-3;

double largest_acceleration(const PathMotion& head, std::size_t axis) {
  double most = 0;
  for (std::size_t i = 0; i < head.pieces(); ++i)
    for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double t = head.begin(i) + part * (head.end(i) - head.begin(i));
      most = std::max(most, std::abs(head.in_piece(i, t)[2][axis]));
    }
  return most;
}

TEST(SmoothHeadCandidates, TakeNoLongerThanAllowedAndAskLessThanTheFineAxesCanDo) {
  const CoarseFineMachine machine = test::md2();
  const JointTask task = test::joint_task(test::holes(4, 3, 30, 6), machine);
  Progress progress;
  HeadPlan<2> plan(task, corner_angle, 1, progress);
  SmoothHeadCandidates<2> heads(plan, 1);
  const double fastest = plan.motion()->duration(), longest = 2 * fastest;
  EXPECT_TRUE(heads.within(fastest * (1 - 1e-3), longest).empty());
  double before = machine.axes[0].fine.acceleration * (1 + 1e-9);
  for (const double stretch : {1.2, 1.4, 1.8}) {
    const double duration = stretch * fastest;
    const std::vector<SmoothHeadCandidate> found = heads.within(duration, longest);
    ASSERT_EQ(found.size(), 3u);
    for (const SmoothHeadCandidate& candidate : found) {
      EXPECT_LE(candidate.head->duration(), duration * (1 + 1e-6));
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_LE(largest_acceleration(*candidate.head, k),
                  candidate.reserve.acceleration_share * machine.axes[k].fine.acceleration * (1 + 1e-6));
    }
    EXPECT_GT(found[1].reserve.acceleration_share, found[2].reserve.acceleration_share);
    EXPECT_GT(found[2].head->duration(), duration * (1 - 5e-3));
    const double most = largest_acceleration(*found[2].head, 0);
    EXPECT_LT(most, before);
    before = most;
  }
}

}  // namespace
}  // namespace bahnwerk
