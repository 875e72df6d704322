#include "core/redundant/methods/reversed_task.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/redundant/methods/method_table.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/split_excess.hpp"

namespace bahnwerk {
namespace {

/// Moves, a circle, a dwell, a curve, another dwell at the end.
Contour mixed() {
  ContourBuilder b(2, {3, -2, 0});
  b.block(Mode::position, unlimited);
  b.line({40, 12, 0});
  b.block(Mode::cut, 300);
  b.arc({40, 12, 0}, {44, 15, 0}, true);
  b.dwell(0.03);
  b.polynomial({{40, 30, -10, 4}, {12, 0, 25, -6}});
  b.block(Mode::position, unlimited);
  b.line({-10, 20, 0});
  b.dwell(0.02);
  return b.finish();
}

TEST(ReversedTask, ItsPlanIsOneOfTheTaskBackwardsInTime) {
  const RedundancyTask task = test::redundancy_task(mixed(), test::md2());
  const RedundancyTask back = reversed(task).value();
  EXPECT_EQ(back.contour->blocks.size(), task.contour->blocks.size());
  EXPECT_EQ(back.contour->blocks.front().mode, Mode::position);
  EXPECT_EQ(back.contour->blocks.front().last, 1u);
  EXPECT_EQ(back.dwells.front().segment, 0u);
  EXPECT_EQ(back.dwells.front().seconds, 0.02);
  Progress progress;
  for (const RedundancyMethod method :
       {RedundancyMethod::joint, RedundancyMethod::iterative, RedundancyMethod::follow_up, RedundancyMethod::filter}) {
    SCOPED_TRACE(name_of<RedundancyMethod>(method, redundancy_methods));
    const RedundancyResult other = test::found(redundancy_row(method).plan(back, {}, progress)),
                           plan = reversed(other, task);
    EXPECT_NEAR(plan.head->duration(), other.head->duration(), 1e-13);
    const test::SplitExcess e = test::split_excess(task, plan);
    EXPECT_LE(e.limits, 1e-4);
    EXPECT_LE(e.jump, 1e-9);
    EXPECT_LE(e.rest, 1e-6);
    EXPECT_LE(e.time, 1e-12);
    for (const double at : {0.05, 0.3, 0.55, 0.8}) {
      const double t = at * plan.head->duration();
      const MotionState x = plan.head->evaluate(t), y = other.head->evaluate(other.head->duration() - t),
                        c = plan.coarse->evaluate(t), d = other.coarse->evaluate(other.head->duration() - t);
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(x[0][k], y[0][k], 1e-9);
        EXPECT_NEAR(x[1][k], -y[1][k], 1e-6);
        EXPECT_NEAR(c[0][k], d[0][k], 1e-9);
      }
    }
    // Pieces lie in their segments, one behind the other.
    double s = 0;
    for (const LawPiece& p : plan.head->law().pieces()) {
      EXPECT_EQ(p.s, s);
      EXPECT_GE(p.s, (*task.path)[p.segment].s0());
      EXPECT_LE(p.s_end, (*task.path)[p.segment].s1());
      s = p.s_end;
    }
    EXPECT_EQ(s, task.path->length());
  }
}

}  // namespace
}  // namespace bahnwerk
