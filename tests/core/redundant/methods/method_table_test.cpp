#include "core/redundant/methods/method_table.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/fine_motion.hpp"

namespace bahnwerk {
namespace {

TEST(Redundancy, EveryMethodHasARow) {
  for (const auto& entry : redundancy_methods) EXPECT_EQ(redundancy_row(entry.value).method, entry.value);
}

TEST(Redundancy, JointIsThePlannerOfThatName) {
  const auto contour = std::make_shared<const Contour>(test::holes(3, 2, 12, 2));
  const JointTask joint = test::joint_task(*contour, test::md2());
  Progress progress;
  JointOptions options;
  options.smoothness = 0.5;
  options.compare = true;
  const JointResult expected = test::found(plan_joint(joint, options, progress));

  RedundancyOptions given;
  given.smoothness = 0.5;
  const RedundancyTask task{joint.path, contour, joint.machine, joint.feeds, joint.rests, joint.dwells};
  const RedundancyResult found = test::found(redundancy_row(RedundancyMethod::joint).plan(task, given, progress));
  EXPECT_EQ(found.head->duration(), expected.chosen.duration);
  EXPECT_EQ(found.fastest, expected.fastest);
  ASSERT_EQ(found.trades.size(), expected.trades.size());
  EXPECT_EQ(found.trades[2].energy, expected.trades[2].energy);
  const auto expected_fine = test::fine_motion(expected.head, *expected.coarse);
  for (const double at : {0.1, 0.5, 0.9}) {
    const double t = at * found.head->duration();
    const MotionState head = found.head->evaluate(t), coarse = found.coarse->evaluate(t),
                      fine = expected_fine->evaluate(t);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(head[0][k] - coarse[0][k], fine[0][k], 1e-12);
      EXPECT_LE(std::abs(head[0][k] - coarse[0][k]), joint.machine.axes[k].stroke);
    }
  }
}

}  // namespace
}  // namespace bahnwerk
