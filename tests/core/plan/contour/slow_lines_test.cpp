// The table of the lines that cost most time: whose they are, how long, and why.
#include "core/plan/contour/slow_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/progress.hpp"
#include "core/contour/gcode.hpp"
#include "core/plan/contour/contour_plan.hpp"

namespace bahnwerk {
namespace {

const Machine machine{{{"x", 1800, 16000, 400000}, {"y", 900, 4000, 400000}}, 0.001};

ContourPlan plan(const char* program, PlanningMethod method = PlanningMethod::time_optimal, double blend = 0) {
  Progress progress;
  ContourPlanning planning;
  planning.method = method;
  if (blend > 0) planning.corner_mode = CornerMode::blend, planning.blend_tolerance = blend;
  return plan_contour(read_gcode(program), machine, planning, progress);
}

TEST(SlowLines, NamesLineTimeAndLimit) {
  const ContourPlan p = plan("G1 X100 F6000\nG1 Y80 F600000\nG4 P0.5\nX0 F60000\n");
  ASSERT_EQ(p.slow_lines.size(), 3u);
  // 100 mm at 100 mm/s; the dwell belongs to the segment before which it stands.
  EXPECT_EQ(p.slow_lines[0].source, 1u);
  EXPECT_EQ(p.slow_lines[0].limit.kind, ActiveLimit::Kind::feed);
  EXPECT_NEAR(p.slow_lines[0].time, 1 + 100.0 / 16000, 2e-3);
  EXPECT_DOUBLE_EQ(p.slow_lines[0].length, 100);
  EXPECT_DOUBLE_EQ(p.slow_lines[0].feed, 100);
  EXPECT_TRUE(p.slow_lines[0].stops);
  EXPECT_GT(p.slow_lines[0].limit_share, 0.95);
  for (const SlowLine& line : p.slow_lines)
    if (line.source == 2) {  // 80 mm at 4000 mm/s² are over before 900 mm/s are reached
      EXPECT_EQ(line.limit.order, 2);
      EXPECT_EQ(line.limit.axis, "y");
    }
  double sum = 0;
  for (const SlowLine& line : p.slow_lines) sum += line.share;
  EXPECT_NEAR(sum, 1, 1e-9);
}

TEST(SlowLines, ADwellIsAReason) {
  const ContourPlan p = plan("G1 X10 F60000\nG4 P3\nY10\n");
  ASSERT_FALSE(p.slow_lines.empty());
  EXPECT_EQ(p.slow_lines[0].limit.kind, ActiveLimit::Kind::dwell);
  EXPECT_GE(p.slow_lines[0].time, 3);
}

TEST(SlowLines, JerkBindsOnShortMoves) {
  const ContourPlan p = plan("G1 X1 F600000\nY1\n", PlanningMethod::jerk_limited);
  ASSERT_EQ(p.slow_lines.size(), 2u);
  for (const SlowLine& line : p.slow_lines) EXPECT_EQ(line.limit.order, 3);
}

TEST(SlowLines, ListsAtMostTwentySlowestFirstForEveryMethod) {
  std::string program = "G1 F30000\n";
  for (int i = 1; i <= 60; ++i) program += "X" + std::to_string(i * i) + " Y" + std::to_string(i % 2 * 5) + "\n";
  for (const PlanningMethod method :
       {PlanningMethod::braking_reserve, PlanningMethod::time_optimal, PlanningMethod::jerk_limited})
    for (const double blend : {0.0, 0.05}) {
      const ContourPlan p = plan(program.c_str(), method, blend);
      ASSERT_EQ(p.slow_lines.size(), 20u);
      EXPECT_EQ(p.slow_lines[0].source, 61u);  // the longest
      for (std::size_t i = 0; i < 20; ++i) {
        const SlowLine& line = p.slow_lines[i];
        EXPECT_GT(line.time, 0);
        EXPECT_LE(line.limit_share, 1 + 1e-12);
        EXPECT_LE(line.time, p.slow_lines[i - std::min<std::size_t>(i, 1)].time);
      }
    }
}

}  // namespace
}  // namespace bahnwerk
