#include "core/plan/contour/driven_segments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/gcode.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/plan/contour/contour_plan.hpp"

namespace bahnwerk {
namespace {

const Machine machine{{{"x", 1000, 16000}, {"y", 500, 4000}}, 0.001};

struct Driven {
  ContourPlan plan;
  std::vector<DrivenSegment> segments;
};

Driven drive(const char* program, double blend = 0) {
  Progress progress;
  ContourPlanning planning;
  planning.method = PlanningMethod::time_optimal;
  if (blend > 0) planning.corner_mode = CornerMode::blend, planning.blend_tolerance = blend;
  Driven out;
  out.plan = plan_contour(read_gcode(program), machine, planning, progress);
  out.segments = driven_segments(*out.plan.path, out.plan.motion->path(), machine, out.plan.motion->law(), progress);
  return out;
}

TEST(DrivenSegments, FollowOneAnotherOverTheWholeMotion) {
  for (const double blend : {0.0, 0.1}) {
    const Driven d = drive("G1 X100 F6000\nG1 Y80 F60000\nG4 P0.5\nG3 X0 I-50\nG0 X0 Y0\n", blend);
    double t = 0, length = 0;
    for (const DrivenSegment& s : d.segments) {
      EXPECT_NEAR(s.start, t, 1e-9);
      EXPECT_GE(s.time, s.least_time * (1 - 1e-9));
      t = s.start + s.time;
      length += s.length;
    }
    EXPECT_NEAR(t, d.plan.setpoints->duration(), 1e-9);
    EXPECT_NEAR(length, d.plan.path_length, 1e-9);
  }
}

TEST(DrivenSegments, HaveLineFeedRestAndTheTimeThatTheyCouldTake) {
  const Driven d = drive("G1 X100 F6000\nG4 P0.5\nY80\nG0 X0\n");
  ASSERT_EQ(d.segments.size(), 4U);
  EXPECT_EQ(d.segments[0].source, 1U);
  EXPECT_DOUBLE_EQ(d.segments[0].least_time, 1);
  EXPECT_TRUE(d.segments[0].rests);
  EXPECT_EQ(d.segments[1].length, 0);  // the dwell
  EXPECT_NEAR(d.segments[1].time, 0.5, 1e-3);
  EXPECT_TRUE(d.segments[1].rests);
  EXPECT_EQ(d.segments[2].source, 3U);
  EXPECT_EQ(d.segments[2].feed, 100);
  EXPECT_TRUE(std::isinf(d.segments[3].feed));
  EXPECT_DOUBLE_EQ(d.segments[3].least_time, 100.0 / 1000);
  EXPECT_EQ(d.segments[3].mode, Mode::position);
}

TEST(DrivenSegments, BlocksTakeAsLongAsThePlanReports) {
  const Driven d = drive("G1 X100 F6000\nG0 Y80\nG4 P0.2\nG1 X0\nG2 X50 Y50 R50\nG0 X0 Y0\n", 0.05);
  std::vector<double> time(d.plan.blocks.size(), 0), length(d.plan.blocks.size(), 0);
  for (const DrivenSegment& s : d.segments) time[s.block] += s.time, length[s.block] += s.length;
  for (std::size_t b = 0; b < time.size(); ++b) {
    EXPECT_NEAR(time[b], d.plan.blocks[b].end_time - d.plan.blocks[b].start_time, 1e-9) << b;
    EXPECT_NEAR(length[b], d.plan.blocks[b].length, 1e-9) << b;
  }
}

}  // namespace
}  // namespace bahnwerk
