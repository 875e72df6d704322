#include "core/cam/optimal/relaxation/known_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

/// Values at the points are what was asked for, one cycle later, too.
TEST(KnownLaw, HasTheValuesOfItsPointsEveryCycle) {
  MotionLawProblem problem;
  problem.method = LawMethod::optimal;
  problem.periodic = true;
  problem.length = 360;
  problem.cycle_duration = 1;
  problem.points = {testing::point_at(0, {testing::fixed(5), testing::fixed(0)}),
                    testing::point_at(150, {testing::fixed(20), testing::fixed(3)})};
  const LawTask task = make_law_task(problem);
  const LawBasis basis(task, 6, 2);
  Progress progress;
  const SplineResult spline = SplineProgram(task, basis, task.middle()).solve({}, progress);
  ASSERT_TRUE(spline.feasible);
  const KnownLaw law(task, basis, spline);
  EXPECT_EQ(law.objective(), spline.objective);
  EXPECT_EQ(law.points()[1].min, task.at[1].min);
  for (const double at : {task.at[1].min, task.at[1].min + task.cycle})
    for (const bool before : {false, true}) {
      EXPECT_NEAR(law.value(at, 0, before), (20 - task.origin) / task.unit_position, 1e-9);
      EXPECT_NEAR(law.value(at, 1, before), 3 * task.to_task(1), 1e-9);
    }
  EXPECT_NEAR(law.value(task.cycle, 0, true), law.value(0, 0, false), 1e-9);
  EXPECT_LE(std::abs(law.value(0.7, 1, false)), law.peak(1) * (1 + 1e-12));
}

}  // namespace
}  // namespace bahnwerk::cam
