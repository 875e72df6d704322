/// Rests of a contour: dwells, stops where the mode changes; and axes that a contour does not move.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/gcode.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/plan/random_contour.hpp"

namespace bahnwerk {
namespace {

const Machine xy{{{"x", 1800, 16000, 400000}, {"y", 900, 12000, 400000}}, 0.001};
const Machine xyz{{{"x", 1800, 16000, 400000}, {"y", 900, 12000, 400000}, {"z", 300, 2000, 50000}}, 0.001};
constexpr PlanningMethod methods[] = {PlanningMethod::time_optimal, PlanningMethod::braking_reserve,
                                      PlanningMethod::jerk_limited};

struct Options {
  PlanningMethod method = PlanningMethod::time_optimal;
  double blend = 0;
  bool stop = false;
};

ContourPlan plan(Contour contour, const Options& options, const Machine& machine = xy) {
  Progress progress;
  ContourPlanning planning;
  planning.method = options.method;
  planning.stop_at_mode_change = options.stop;
  if (options.blend > 0) planning.corner_mode = CornerMode::blend, planning.blend_tolerance = options.blend;
  return plan_contour(std::move(contour), machine, planning, progress);
}

std::string failures(const ContourPlan& p) {
  std::string text;
  for (const Check& c : p.verification.checks)
    if (!c.passed)
      text += check_name(c) + " limit " + std::to_string(c.limit) + " value " + std::to_string(c.value) + "; ";
  return text;
}

std::vector<double> column(const ContourPlan& p, const std::string& name) {
  const auto& columns = p.setpoints->columns();
  std::size_t k = 0;
  while (k < columns.size() && columns[k].name != name) ++k;
  std::vector<double> rows(p.setpoints->count() * columns.size()), values;
  p.setpoints->read(0, p.setpoints->count(), rows.data());
  for (std::size_t i = k; i < rows.size(); i += columns.size()) values.push_back(rows[i]);
  return values;
}

/// How long the tool stands within 1e-6 mm of a place, s, as the setpoints tell.
double standing(const ContourPlan& p, double x, double y) {
  const auto xs = column(p, "x"), ys = column(p, "y"), v = column(p, "v");
  double rows = 0;
  for (std::size_t i = 0; i < xs.size(); ++i) rows += std::hypot(xs[i] - x, ys[i] - y) < 1e-6 && v[i] == 0;
  return (rows - 1) * p.setpoints->cycle_time();
}

/// Half a metre in three directions, a corner of 90°, an arc that goes on smoothly, and a line that does.
Contour shape(double dwell_in_corner, double dwell_on_the_way, double dwell_at_begin = -1, double dwell_at_end = -1) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, 400);
  if (dwell_at_begin >= 0) b.dwell(dwell_at_begin);
  b.line({100, 0, 0});
  if (dwell_in_corner >= 0) b.dwell(dwell_in_corner);
  b.line({100, 60, 0});
  b.block(Mode::position, unlimited);
  b.arc({80, 80, 0}, {80, 60, 0}, true);
  b.line({40, 80, 0});
  b.block(Mode::cut, 300);
  if (dwell_on_the_way >= 0) b.dwell(dwell_on_the_way);
  b.line({0, 80, 0});
  if (dwell_at_end >= 0) b.dwell(dwell_at_end);
  return b.finish();
}

TEST(Dwell, LastsExactlyAsLongAsAskedBesideTheStop) {
  for (const PlanningMethod method : methods)
    for (const double blend : {0.0, 0.5})
      for (const double d : {1e-4, 0.25, 7.0, 3600.0}) {
        SCOPED_TRACE(std::to_string(static_cast<int>(method)) + " " + std::to_string(blend) + " " + std::to_string(d));
        Machine machine = xy;
        if (d > 100) machine.cycle_time = 0.1;
        const ContourPlan stop = plan(shape(0, 0), {method, blend}, machine),
                          stay = plan(shape(d, 2 * d), {method, blend}, machine);
        ASSERT_TRUE(stop.verification.passed) << failures(stop);
        ASSERT_TRUE(stay.verification.passed) << failures(stay);
        EXPECT_NEAR(stay.duration, stop.duration + 3 * d, 1e-12 * stay.duration);
        EXPECT_NEAR(stay.bound.value, stop.bound.value + 3 * d, 2e-12 * stay.duration);
        EXPECT_GE(stay.bound.gap, 0);
        EXPECT_NEAR(stay.cut_time, stop.cut_time + 3 * d, 1e-9 * stay.duration);
        EXPECT_NEAR(stay.position_time, stop.position_time, 1e-9 * stay.duration);
        EXPECT_EQ(stay.path_length, stop.path_length);
        if (d > 100) continue;
        EXPECT_GE(standing(stay, 100, 0), d - 2e-3);
        EXPECT_LE(standing(stay, 100, 0), d * 1.001 + 1e-3);
        EXPECT_GE(standing(stay, 40, 80), 2 * d - 2e-3);
        EXPECT_GE(stay.duration, plan(shape(-1, -1), {method, blend}).duration + 3 * d);
      }
}

TEST(Dwell, RestsAtBeginAndEnd) {
  for (const PlanningMethod method : methods)
    for (const double blend : {0.0, 0.5}) {
      const ContourPlan none = plan(shape(-1, -1), {method, blend}),
                        both = plan(shape(-1, -1, 0.5, 0.75), {method, blend});
      ASSERT_TRUE(both.verification.passed) << failures(both);
      EXPECT_NEAR(both.duration, none.duration + 1.25, 1e-12 * both.duration);
      EXPECT_NEAR(standing(both, 0, 0), 0.5, 2e-3);
      EXPECT_NEAR(standing(both, 0, 80), 0.75, 2e-3);
      EXPECT_EQ(both.blocks.front().start_time, 0);
      const auto v = column(both, "v"), a = column(both, "ax");
      EXPECT_EQ(v[400], 0);
      EXPECT_EQ(a[400], 0);
      EXPECT_EQ(v[v.size() - 300], 0);
    }
}

TEST(Dwell, AStopOnAStraightLineIsTwoLines) {
  ContourBuilder b(2, {});
  b.line({50, 0, 0});
  b.dwell(0);
  b.line({100, 0, 0});
  const ContourPlan p = plan(b.finish(), {});
  ASSERT_TRUE(p.verification.passed) << failures(p);
  EXPECT_NEAR(p.duration, 2 * 2 * std::sqrt(50.0 / 16000), 1e-12);
  EXPECT_LE(p.bound.gap, 1e-11);
}

TEST(Dwell, BlocksOfDwellsAloneHaveTheirTime) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 100);
  b.dwell(0.1);
  b.block(Mode::position, unlimited);
  b.line({50, 0, 0});
  b.block(Mode::cut, 100);
  b.dwell(0.2);
  b.block(Mode::position, unlimited);
  b.dwell(0.3);
  b.dwell(0.05);
  b.block(Mode::cut, 100);
  b.block(Mode::cut, 100);
  b.line({100, 0, 0});
  b.block(Mode::position, unlimited);
  b.dwell(0.4);
  const ContourPlan p = plan(b.finish(), {});
  ASSERT_TRUE(p.verification.passed) << failures(p);
  ASSERT_EQ(p.blocks.size(), 7u);
  const double slow = p.setpoints->duration() / p.duration;
  const auto lasts = [&](std::size_t i) { return p.blocks[i].end_time - p.blocks[i].start_time; };
  EXPECT_NEAR(lasts(0), 0.1, 0.1 * slow - 0.1 + 1e-12);
  EXPECT_NEAR(lasts(2), 0.2, 0.2 * slow - 0.2 + 1e-12);
  EXPECT_NEAR(lasts(3), 0.35, 0.35 * slow - 0.35 + 1e-12);
  EXPECT_EQ(lasts(4), 0);
  EXPECT_NEAR(lasts(6), 0.4, 0.4 * slow - 0.4 + 1e-12);
  EXPECT_GT(lasts(5), 0.5);
  for (std::size_t i = 1; i < 7; ++i) EXPECT_EQ(p.blocks[i].start_time, p.blocks[i - 1].end_time);
  EXPECT_NEAR(p.cut_time + p.position_time, p.duration, 1e-12);
  // The setpoints name the block of the dwell, and none of a block of nothing.
  const auto block = column(p, "block"), mode = column(p, "mode"), v = column(p, "v");
  const auto rows = [&](double of) { return static_cast<double>(std::count(block.begin(), block.end(), of)); };
  EXPECT_NEAR(rows(0), 100, 1);
  EXPECT_NEAR(rows(2), 200, 1);
  EXPECT_NEAR(rows(3), 350, 1);
  EXPECT_EQ(rows(4), 0);
  EXPECT_NEAR(rows(6), 400, 2);
  for (std::size_t i = 0; i < block.size(); ++i) {
    EXPECT_EQ(mode[i], block[i] == 0 || block[i] == 2 || block[i] == 5 ? 1 : 0) << i;
    if (block[i] == 2 || block[i] == 3) {
      EXPECT_EQ(v[i], 0) << i;
    }
  }
}

TEST(Dwell, RestsAtACusp) {
  ContourBuilder b(2, {-5, 0, 0});
  b.line({0, 0, 0});
  b.dwell(0.05);
  b.polynomial({{0, 0, 10, 0}, {0, 0, 0, 10}});  // (u², u³): begins in a cusp, with infinite curvature
  for (const PlanningMethod method : {PlanningMethod::time_optimal, PlanningMethod::braking_reserve}) {
    ContourBuilder copy = b;
    const ContourPlan p = plan(copy.finish(), {method});
    ASSERT_TRUE(p.verification.passed) << failures(p);
    for (const char* name : {"x", "y", "vx", "vy", "ax", "ay"})
      for (const double value : column(p, name)) ASSERT_TRUE(std::isfinite(value)) << name;
    EXPECT_NEAR(standing(p, 0, 0), 0.05, 2e-3);
  }
}

/// Dwells at random joints and ends.
void scatter(Contour& contour, Random& random) {
  std::size_t block = 0;
  for (std::size_t i = 0; i <= contour.path.size(); ++i) {
    while (block + 1 < contour.blocks.size() && i >= contour.blocks[block].last) ++block;
    if (!random.chance(0.3)) continue;
    contour.rests.push_back({i, random.uniform(0, 2), block});
    if (random.chance(0.3)) contour.rests.push_back({i, random.uniform(0, 0.2), block});
  }
}

TEST(Dwell, RandomContoursAreExactlyLongerAndVerified) {
  Random random(7011);
  for (int i = 0; i < testing::cases(120); ++i) {
    SCOPED_TRACE(i);
    const std::size_t dimension = random.chance(0.25) ? 3 : 2;
    const testing::Outline outline = testing::random_outline(random, 1 + random.below(6), dimension);
    Machine machine = testing::random_machine(random, dimension);
    for (AxisLimits& axis : machine.axes) axis.jerk = axis.acceleration * 30;
    const Options options{methods[i % 3], 0, random.chance(0.3)};
    Contour stays = build(outline);
    scatter(stays, random);
    Contour stops = stays;
    for (Rest& rest : stops.rests) rest.seconds = 0;
    const double dwell = stays.dwell();
    const ContourPlan without = plan(stops, options, machine), with = plan(stays, options, machine);
    ASSERT_TRUE(without.verification.passed) << failures(without);
    ASSERT_TRUE(with.verification.passed) << failures(with);
    ASSERT_NEAR(with.duration, without.duration + dwell, 1e-12 * with.duration);
    ASSERT_GE(with.bound.gap, 0);
    const ContourPlan free = plan(build(outline), {options.method}, machine);
    ASSERT_GE(without.duration, free.duration * (1 - (i % 3 == 2 ? 2e-3 : 1e-5)));
    ASSERT_GE(without.bound.value, free.bound.value * (1 - 1e-5));
  }
}

TEST(Dwell, RoundedPathsGoExactlyThroughTheRests) {
  Random random(7012);
  for (int i = 0; i < testing::cases(24); ++i) {
    SCOPED_TRACE(i);
    ContourBuilder b(2, {});
    Vec at;
    double heading = 0, dwell = 0;
    std::vector<Vec> places;
    const double size = std::pow(10, random.uniform(-1, 1));  // mm: runs of short lines, and corners between long ones
    for (int k = 0; k < 60; ++k) {
      if (k % 15 == 0) b.block(random.chance(0.5) ? Mode::cut : Mode::position, random.uniform(20, 400));
      heading += random.uniform(-1, 1);
      at = at + size * random.uniform(0.3, 1) * testing::direction(heading);
      b.line(at);
      if (!random.chance(0.15)) continue;
      places.push_back(at);
      b.dwell(0.02);
      dwell += 0.02;
    }
    const Options options{methods[i % 2], 0.05, random.chance(0.3)};
    const Contour contour = b.finish();
    const ContourPlan p = plan(contour, options);
    ASSERT_TRUE(p.verification.passed) << failures(p);
    for (const Vec place : places) ASSERT_GE(standing(p, place.x, place.y), 0.018);
    Contour stops = contour;
    for (Rest& rest : stops.rests) rest.seconds = 0;
    ASSERT_NEAR(plan(stops, options).duration + dwell, p.duration, 1e-12 * p.duration);
  }
}

TEST(ModeChange, StopRestsAtEveryBorderAndIsNeverFaster) {
  for (const PlanningMethod method : methods)
    for (const double blend : {0.0, 0.5}) {
      const ContourPlan pass = plan(shape(-1, -1), {method, blend}), stop = plan(shape(-1, -1), {method, blend, true});
      ASSERT_TRUE(stop.verification.passed) << failures(stop);
      EXPECT_GT(stop.duration, pass.duration);
      EXPECT_GT(stop.bound.value, pass.bound.value);
      std::vector<double> v;
      const auto xs = column(stop, "x"), ys = column(stop, "y"), speed = column(stop, "v");
      double slowest[2] = {1e9, 1e9};
      for (std::size_t i = 0; i < xs.size(); ++i) {
        if (std::hypot(xs[i] - 100, ys[i] - 60) < 1) slowest[0] = std::min(slowest[0], speed[i]);
        if (std::hypot(xs[i] - 40, ys[i] - 80) < 1) slowest[1] = std::min(slowest[1], speed[i]);
      }
      EXPECT_LT(slowest[0], 20);
      EXPECT_LT(slowest[1], 20);
      bool checked = false;
      for (const Check& c : stop.verification.checks) checked |= check_name(c) == "dwell" && c.passed;
      EXPECT_TRUE(checked);
    }
}

TEST(StandingAxes, ContoursInThePlaneDoNotDependOnThem) {
  for (const PlanningMethod method : methods)
    for (const double blend : {0.0, 0.5}) {
      const ContourPlan two = plan(shape(-1, 0.1), {method, blend}, xy),
                        three = plan(shape(-1, 0.1), {method, blend}, xyz);
      ASSERT_TRUE(three.verification.passed) << failures(three);
      EXPECT_EQ(three.duration, two.duration);
      EXPECT_EQ(three.bound.value, two.bound.value);
      for (const char* name : {"x", "y", "vx", "vy", "ax", "ay", "s", "v"})
        EXPECT_EQ(column(three, name), column(two, name));
      for (const char* name : {"z", "vz", "az"}) {
        const auto values = column(three, name);
        ASSERT_EQ(values.size(), three.setpoints->count()) << name;
        EXPECT_EQ(std::count(values.begin(), values.end(), 0.0), static_cast<std::ptrdiff_t>(values.size())) << name;
      }
    }
}

TEST(StandingAxes, KeepTheHeightOfAPartProgram) {
  const Contour program = read_gcode("G0 X0 Y0 Z-3\nF600 G1 X10\nG3 X20 Y10 R10\nG4 P0.1");
  for (const double blend : {0.0, 0.1}) {
    const ContourPlan p = plan(program, {PlanningMethod::time_optimal, blend}, xyz);
    ASSERT_TRUE(p.verification.passed) << failures(p);
    const auto z = column(p, "z");
    EXPECT_EQ(std::count(z.begin(), z.end(), -3.0), static_cast<std::ptrdiff_t>(z.size()));
    EXPECT_EQ(p.notes.back(), "axis z stands still at -3 mm: the contour is planar");
  }
}

}  // namespace
}  // namespace bahnwerk
