#include "core/redundant/known/geometric.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/redundant/known/known_plans.hpp"

namespace bahnwerk {
namespace {

using test::expect_valid, test::plan;

TEST(KnownMethods, GeometricallySplitAllAxesStopAtCorners) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, 400);
  for (const Vec& p : {Vec{30, 0, 0}, Vec{30, 30, 0}, Vec{0, 30, 0}, Vec{5, 5, 0}}) b.line(p);
  const RedundancyTask task = test::redundancy_task(b.finish(), test::md2());
  const RedundancyResult r = plan(task, RedundancyMethod::geometric);
  expect_valid(task, r);
  int corners = 0;
  for (std::size_t i = 1; i < r.head->pieces(); ++i) {
    const LawPiece& p = r.head->law().pieces()[i];
    if (p.segment == r.head->law().pieces()[i - 1].segment) continue;
    ++corners;
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(r.coarse->evaluate(p.t0)[1][k], 0, 1e-6);
  }
  EXPECT_EQ(corners, 3);
}

TEST(KnownMethods, TheCoarseCurveStaysWithinTheStroke) {
  const RedundancyTask task = test::redundancy_task(test::holes(4, 4, 80, 30), test::md2());
  Progress progress;
  const auto curve = coarse_curve(*task.path, task.machine, progress);
  EXPECT_GE(curve->pitch(), 0.98 * 20);
  for (double s = 0; s < task.path->length(); s += 0.1) {
    const std::size_t i = task.path->tool().find(s);
    const AxisJet q = curve->at(i, s, {});
    const AxisArray x = task.path->at(i, s).value;
    for (std::size_t k = 0; k < 2; ++k) ASSERT_LE(std::abs(x[k] - q.value[k]), 20) << s;
    if (s > 1 && s + 1 < task.path->length()) {  // derivatives
      const AxisJet more = curve->at(i, s + 1e-4, {}), less = curve->at(i, s - 1e-4, {});
      for (std::size_t k = 0; k < 2; ++k) {
        ASSERT_NEAR(q.d1[k], (more.value[k] - less.value[k]) / 2e-4, 1e-6);
        ASSERT_NEAR(q.d2[k], (more.d1[k] - less.d1[k]) / 2e-4, 1e-5);
        ASSERT_LE(std::abs(q.d1[k]), 1 + 1e-12);
      }
    }
  }
}

/// Along a straight tool path the coarse curve is slow at both ends and as quick as the tool between them.
TEST(KnownMethods, GeometricallySplitStraightMovesAreQuickerThanTheCoarseAxesAlone) {
  for (const CoarseFineMachine& machine : {test::md1(), test::md2()})
    for (const double length : {7.0, 90.0, 310.0, 620.0, 1900.0}) {
      SCOPED_TRACE(length);
      const RedundancyTask task = test::redundancy_task(test::straight(length, 0), machine);
      const RedundancyResult r = plan(task, RedundancyMethod::geometric);
      expect_valid(task, r);
      const double V = machine.axes[0].coarse.velocity, A = machine.axes[0].coarse.acceleration;
      EXPECT_LT(r.head->duration(), length > V * V / A ? length / V + V / A : 2 * std::sqrt(length / A));
    }
}

}  // namespace
}  // namespace bahnwerk
