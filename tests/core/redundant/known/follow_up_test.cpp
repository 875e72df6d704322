#include "core/redundant/known/follow_up.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/redundant/known/known_plans.hpp"

namespace bahnwerk {
namespace {

using test::expect_valid, test::plan;

TEST(KnownMethods, FollowingUpTheCoarseAxesStandWhereTheFineOnesCut) {
  const RedundancyTask task = test::redundancy_task(test::holes(3, 2, 60, 5), test::md2());
  const RedundancyResult r = plan(task, RedundancyMethod::follow_up);
  expect_valid(task, r);
  std::size_t cut = 0;
  for (std::size_t i = 0; i < r.head->pieces(); ++i) {
    const LawPiece& p = r.head->law().pieces()[i];
    if (p.segment % 2 == 0 || !(p.duration > 0)) continue;  // a line, then a circle
    const MotionState g = r.coarse->evaluate(p.t0 + 0.5 * p.duration);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(g[1][k], 0, 1e-7);
    ++cut;
  }
  EXPECT_GE(cut, 6u);
}

TEST(KnownMethods, FollowingUpTheCoarseAxesAloneCutWhatDoesNotFit) {
  const RedundancyTask task = test::redundancy_task(test::holes(2, 2, 150, 50), test::md2());
  const RedundancyResult r = plan(task, RedundancyMethod::follow_up);
  expect_valid(task, r);
  for (double t = 0; t < r.head->duration(); t += 0.001) {
    const double x = r.head->evaluate(t)[0][0] - r.coarse->evaluate(t)[0][0];
    EXPECT_NEAR(x, 0, 1e-6);
  }
}

}  // namespace
}  // namespace bahnwerk
