#include "core/probe/arcs/turn.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk::probe {
namespace {

TEST(Turn, OneDirectionIsNoTurn) {
  const ProbeProblem p = probe_cases::problem({{0, 0}, {1, 0}}, 0.1);
  const Turn none(p, {1, 0}, {1, 0});
  EXPECT_FALSE(none.any());
  EXPECT_EQ(none.size(5).duration, 0);
  EXPECT_EQ(none.size(5).length, 0);
  EXPECT_FALSE(Turn(p, {1, 0}, {1, 1e-16}).any()) << "rounding";
  EXPECT_TRUE(Turn(p, {1, 0}, {-1, 0}).any());
}

TEST(Turn, AtHighSpeedTheAccelerationDecides) {
  // A change of speed Δ under A, J, S alone takes Δ/A + A/J + J/S where all limits are reached.
  const ProbeProblem p = probe_cases::problem({{0, 0}, {1, 0}}, 0.1);
  const double v = 40;
  EXPECT_NEAR(Turn(p, {1, 0}, {0, 1}).size(v).duration, v / 200 + 200 / 4000.0 + 4000 / 200000.0, 1e-12);
  EXPECT_NEAR(Turn(p, {1, 0}, {-1, 0}).size(v).duration, 2 * v / 200 + 200 / 4000.0 + 4000 / 200000.0, 1e-12);
}

TEST(Turn, TheWrittenMotionPassesFromEntryToExitAndIsNeverFaster) {
  for (const Vec out : {Vec{0, 1}, Vec{-0.8, 0.6}, Vec{0.96, -0.28}, Vec{-1, 0}}) {
    const ProbeProblem p = probe_cases::problem({{0, 0}, {9, 0}, {9, 9}}, 0.1);
    const Turn turn(p, {1, 0}, out);
    const double v = 3;
    const TurnSize size = turn.size(v);
    const Vec at{0, 0}, apex = turn.apex(at, size), entry = apex - size.length * Vec{1, 0};
    ProbeProblem from = p;
    from.points[0] = entry;
    MotionWriter writer(from);
    turn.append(writer, v, at, 1);
    EXPECT_NEAR(writer.time(), size.duration, 1e-14);
    EXPECT_LE(norm(writer.position() - (apex + size.length * out)), 1e-13);
    const ProbeMotion motion = writer.finish();
    EXPECT_NEAR(motion.times[1], size.duration / 2, 1e-14) << "the point is passed at half the time";
    double farthest = 0;
    for (double t = 0; t <= size.duration; t += size.duration / 500) {
      const MotionState s = motion.motion->evaluate(t);
      EXPECT_LE(std::hypot(s[1][0], s[1][1]), v * (1 + 1e-12));
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_LE(std::abs(s[2][k]), 200 * (1 + 1e-9));
        EXPECT_LE(std::abs(s[3][k]), 4000 * (1 + 1e-9));
      }
      const Vec x{s[0][0], s[0][1]};
      farthest = std::max(
          farthest, t < size.duration / 2 ? distance_from_edge(x, {-9, 0}, at) : distance_from_edge(x, at, 9 * out));
    }
    const MotionState middle = motion.motion->evaluate(size.duration / 2);
    EXPECT_LE(std::hypot(middle[0][0], middle[0][1]), 1e-13);
    // Its deviation is that of the densest samples.
    const double deviation = turn.deviation(v, {{-9, 0}, at, 9 * out, 1}, 0);
    EXPECT_GE(deviation, farthest * (1 - 1e-9) - 1e-15) << "but for the rounding of a turn on its own line";
    EXPECT_LE(deviation, farthest * (1 + 1e-3) + 1e-12);
  }
}

}  // namespace
}  // namespace bahnwerk::probe
