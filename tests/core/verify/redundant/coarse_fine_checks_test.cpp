#include "core/verify/redundant/coarse_fine_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/law/path_motion.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

std::vector<AxisLimits> limits(const char* letter, double velocity, double acceleration, double jerk, double stroke) {
  std::vector<AxisLimits> list;
  for (const char* axis : {"x", "y"}) {
    list.emplace_back(std::string(axis) + letter, velocity, acceleration, jerk);
    if (stroke < unlimited) list.back().lowest = -stroke, list.back().highest = stroke;
  }
  return list;
}

struct Case {
  std::shared_ptr<const AxisPath> path;
  TimeLaw law;
  std::vector<SplineMotion::Piece> coarse;
  std::vector<AxisLimits> coarse_axes = limits("c", 1e4, 1e5, unlimited, unlimited);
  std::vector<AxisLimits> fine_axes = limits("f", 1e4, 1e6, unlimited, 100);
  int order = 2;
  double cycle_time = 0;

  std::vector<Check> checks() const {
    const SplineMotion motion(coarse);
    CoarseFineToVerify input{*path, law, motion, coarse_axes, fine_axes};
    input.order = order;
    input.cycle_time = cycle_time;
    Progress progress;
    return coarse_fine_checks(input, progress);
  }
};

Check find(const std::vector<Check>& checks, const std::string& name) {
  for (const Check& c : checks)
    if (check_name(c) == name) return c;
  ADD_FAILURE() << "no check " << name;
  return {};
}

std::shared_ptr<const AxisPath> path_of(ContourBuilder& builder) {
  return contour_axes(std::make_shared<const Contour>(builder.finish()), 2);
}

/// A line of 10 mm, 0.1 s up and 0.1 s down at 1000 mm/s².
Case line() {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, unlimited);
  b.line({10, 0, 0});
  Case c{path_of(b), {}, {}};
  c.law.append({0, 0.1, 0, 5, 0, 1000, 0, 0});
  c.law.append({0, 0.1, 5, 10, 100, -1000, 0, 0});
  c.coarse = {{0.2, {{4}, {1}}}};
  return c;
}

/// A circle of radius 8 about the origin at a constant 200 mm/s.
Case circle() {
  ContourBuilder b(2, {8, 0, 0});
  b.block(Mode::cut, unlimited);
  b.arc({8, 0, 0}, {0, 0, 0}, true);
  Case c{path_of(b), {}, {}};
  const double length = c.path->length();
  c.law.append({0, length / 200, 0, length, 200, 0, 0, 0});
  c.coarse = {{length / 200, {{0}, {0}}}};
  return c;
}

TEST(CoarseFineChecks, OnALineTheFineAxisDoesWhatTheCoarseLeaves) {
  const auto checks = line().checks();
  EXPECT_DOUBLE_EQ(find(checks, "stroke xf").value, 6);
  EXPECT_DOUBLE_EQ(find(checks, "stroke yf").value, 1);
  EXPECT_DOUBLE_EQ(find(checks, "velocity xf").value, 100);
  EXPECT_NEAR(find(checks, "velocity xf").at, 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(find(checks, "acceleration xf").value, 1000);
  for (const Check& c : checks) EXPECT_TRUE(c.passed) << check_name(c);
}

/// x_c = 50 t² would follow exactly; of x_c = 40 t² a tenth of the way is left at 0.1 s.
TEST(CoarseFineChecks, ACoarsePolynomialIsTakenAway) {
  Case c = line();
  c.coarse = {{0.1, {{0, 0, 400}, {0}}}, {0.2, {{4, 80, -400}, {0}}}};
  const auto checks = c.checks();
  EXPECT_NEAR(find(checks, "stroke xf").value, 2, 1e-12);
  EXPECT_NEAR(find(checks, "velocity xf").value, 20, 1e-11);
  EXPECT_NEAR(find(checks, "acceleration xf").value, 200, 1e-9);
  EXPECT_NEAR(find(checks, "acceleration xc").value, 800, 1e-9);
}

TEST(CoarseFineChecks, OnACircleThePeaksAreThoseOfTheCircle) {
  const auto checks = circle().checks();
  for (const char* axis : {"xf", "yf"}) {
    for (const auto& [name, value] :
         {std::pair<const char*, double>{"stroke ", 8}, {"velocity ", 200}, {"acceleration ", 200.0 * 200 / 8}}) {
      const Check c = find(checks, std::string(name) + axis);
      EXPECT_GE(c.value, value * (1 - 1e-14)) << check_name(c);
      EXPECT_LE(c.value, value * (1 + 1e-9)) << check_name(c);
    }
  }
}

/// Between two samples of 1 ms a peak shows only to enclosures.
TEST(CoarseFineChecks, LimitsJustBelowThePeakAreExceededJustAboveAreNot) {
  for (const double factor : {1 - 1e-6, 1 + 1e-6}) {
    Case c = circle();
    c.fine_axes = limits("f", 200 * factor, 5000 * factor, unlimited, 8 * factor);
    const auto checks = c.checks();
    for (const char* name : {"stroke xf", "velocity yf", "acceleration xf"})
      EXPECT_EQ(find(checks, name).passed, factor > 1) << name << " " << factor;
  }
}

/// The coarse axes go round with the tool on a polynomial of degree 4, whose difference has a closed form.
TEST(CoarseFineChecks, OnACirclePolynomialsAreTakenAway) {
  Case c = circle();
  const double T = c.law.duration();
  c.coarse = {{T, {{8, 0, -3, 20, 0.5}, {0, 5, 2, 1, -7}}}};
  const auto checks = c.checks();
  double stroke = 0, acceleration = 0;
  for (int i = 0; i <= 200000; ++i) {
    const double t = T * i / 200000, w = 200.0 / 8;
    stroke = std::max(stroke, std::abs(8 * std::cos(w * t) - (8 + t * t * (-3 + t * (20 + 0.5 * t)))));
    acceleration = std::max(acceleration, std::abs(-8 * w * w * std::cos(w * t) - (-6 + t * (120 + 6 * t))));
  }
  EXPECT_NEAR(find(checks, "stroke xf").value, stroke, 1e-7);
  EXPECT_NEAR(find(checks, "acceleration xf").value, acceleration, 1e-4);
  EXPECT_GE(find(checks, "stroke xf").value, stroke * (1 - 1e-13));
}

TEST(CoarseFineChecks, JerkIsHeldWhereItIsAskedFor) {
  Case c = circle();
  c.order = 3;
  c.fine_axes = limits("f", 1e4, 1e6, 200.0 * 200 * 200 / 64 * (1 - 1e-6), 100);
  EXPECT_FALSE(find(c.checks(), "jerk xf").passed);
  c.fine_axes = limits("f", 1e4, 1e6, 200.0 * 200 * 200 / 64 * (1 + 1e-6), 100);
  EXPECT_TRUE(find(c.checks(), "jerk xf").passed);
}

TEST(CoarseFineChecks, FaultsOfTheCoarseMotionShow) {
  Case jump = line();
  jump.coarse = {{0.1, {{4}, {1}}}, {0.2, {{4 + 1e-9}, {1}}}};
  EXPECT_FALSE(find(jump.checks(), "coarse continuity of position").passed);
  Case kink = line();
  kink.coarse = {{0.1, {{4}, {1}}}, {0.2, {{4, 1e-6}, {1}}}};
  EXPECT_FALSE(find(kink.checks(), "coarse continuity of velocity").passed);
  EXPECT_FALSE(find(kink.checks(), "coarse end at rest").passed);
  Case shorter = line();
  shorter.coarse = {{0.2 - 1e-9, {{4}, {1}}}};
  EXPECT_FALSE(find(shorter.checks(), "coarse duration").passed);
  Case range = line();
  range.coarse_axes[0].lowest = 0, range.coarse_axes[0].highest = 3.999;
  EXPECT_FALSE(find(range.checks(), "range xc").passed);
  Case lost = line();
  lost.coarse[0].axes[0] = {std::nan("")};
  EXPECT_FALSE(find(lost.checks(), "stroke xf").passed);
  Case switches = line();  // of a head that switches at 0.1 s, a microsecond late
  switches.coarse = {{0.1 + 1e-6, {{0, 0, 500}, {0}}}, {0.2, {{500 * 0.100001 * 0.100001, 100.001, -499.99}, {0}}}};
  switches.fine_axes = limits("f", 1e4, 1000, unlimited, 100);
  EXPECT_NEAR(find(switches.checks(), "acceleration xf").value, 2000, 1e-6);
  EXPECT_FALSE(find(switches.checks(), "acceleration xf").passed);
}

/// Two lines of 10 mm that meet under an angle, passed at 100 mm/s; y has no fine axis.
Case bent(double velocity_at_begin, double velocity_behind, double angle = 1e-3) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, unlimited);
  b.line({10, 0, 0});
  b.line({10 + 10 * std::cos(angle), 10 * std::sin(angle), 0});
  Case c{path_of(b), {}, {}};
  c.law.append({0, 0.1, 0, 5, 0, 1000, 0, 0});
  c.law.append({0, 0.05, 5, 10, 100, 0, 0, 0});
  c.law.append({0, 0.05, 10, 15, 100, 0, 0, 1});
  c.law.append({0, 0.1, 15, 20, 100, -1000, 0, 1});
  const double v = 100 * std::sin(angle), low = velocity_at_begin, high = velocity_behind * v;
  c.coarse = {{0.1, {{4}, {0}}},
              {0.15, {{4}, {0, low, -low / 0.05}}},
              {0.2, {{4}, {0, high, (v - high) / 0.1}}},
              {0.3, {{4}, {0.05 * (v + high) / 2, v, -5 * v}}}};
  c.fine_axes[1] = AxisLimits("yf", 0, 0);
  c.fine_axes[1].lowest = c.fine_axes[1].highest = 0;
  c.cycle_time = 1e-3;
  return c;
}

/// A coarse axis' acceleration of 1e5 mm/s² is 100 mm/s in a cycle: what jumps is a thousandth of that.
TEST(CoarseFineChecks, AnAxisWithoutAFineOneStepsWithTheTangentAndNowhereElse) {
  const auto continuous = [](const Case& c) { return find(c.checks(), "coarse continuity of velocity").passed; };
  EXPECT_TRUE(continuous(bent(0, 1)));
  EXPECT_FALSE(continuous(bent(1e-3, 1)));   // where the law changes, on a straight line
  EXPECT_FALSE(continuous(bent(0, 1.001)));  // more than the tangent does
  Case small = bent(0, 1);
  small.cycle_time = 1e-7;  // 0.01 mm/s
  EXPECT_FALSE(continuous(small));
}

/// Lets both fine axes move by up to 100 mm; that of y does not stand still, because its coarse axis is 1 nm aside.
void split(Case& c) {
  c.fine_axes = limits("f", 1e4, 1e6, unlimited, 100);
  for (SplineMotion::Piece& piece : c.coarse) piece.axes[1][0] += 1e-6;
}

/// A fine axis that is never used takes nothing from what the coarse axis may do without it.
TEST(CoarseFineChecks, UnderAFineAxisThatStandsStillACoarseOneStepsAsWithoutIt) {
  const auto continuous = [](const Case& c) { return find(c.checks(), "coarse continuity of velocity").passed; };
  Case still = bent(0, 1);
  still.fine_axes = limits("f", 1e4, 1e6, unlimited, 100);
  EXPECT_LE(find(still.checks(), "stroke yf").value, 1e-12);
  EXPECT_TRUE(continuous(still));
  still.cycle_time = 1e-7;  // 0.01 mm/s
  EXPECT_FALSE(continuous(still));
  Case moves = bent(0, 1);
  split(moves);
  EXPECT_FALSE(continuous(moves));
}

/// Only an arc's points come from its centre: a curve that is hardly bent has no more rounding than a line of its
/// length, though its radius of curvature is 5e10 mm.
TEST(CoarseFineChecks, AHardlyBentCurveHasTheRoundingOfALine) {
  for (const auto& [angle, passes] : {std::pair{2e-14, true}, {1e-6, false}}) {
    Case c = bent(0, 1, angle);
    ContourBuilder b(2, {0, 0, 0});
    b.block(Mode::cut, unlimited);
    b.polynomial({{0, 10}, {0, 0, 1e-9}});
    b.line({10 + 10 * std::cos(angle), 1e-9 + 10 * std::sin(angle), 0});
    c.path = path_of(b);
    split(c);
    const AxisJet q = c.path->at_parameter(0, (*c.path)[0].curve().end());
    ASSERT_NEAR(q.d2[1], 2e-11, 1e-13);
    EXPECT_EQ(find(c.checks(), "coarse continuity of velocity").passed, passes) << angle;
  }
}

/// An end that is off by 32 ε of 20 mm turns a line of 10 mm by 1.4e-14; beside another one that is 2.8e-14.
TEST(CoarseFineChecks, WhatTheRoundingOfPointsTurnsCoarseAxesTake) {
  for (const auto& [angle, passes] : {std::pair{2e-14, true}, {1e-12, false}}) {
    Case c = bent(0, 1, angle);
    split(c);
    EXPECT_EQ(find(c.checks(), "coarse continuity of velocity").passed, passes) << angle;
  }
}

/// A bend of 15 µm behind a line of 15 mm, taken at 1.3 mm/s: two pieces of the law meet in it, and the coarse axes go
/// on from a path length that is off there. 32 ε of 15 mm, twice, are 2.1e-13 mm, which the bend turns into 1.9e-11
/// mm/s; the rounding of the velocities themselves is 4e-14 mm/s.
TEST(CoarseFineChecks, WhatABendMakesOfTheRoundingOfPathLengthsCoarseAxesTake) {
  constexpr double radius = 0.015, speed = 1.3;
  for (const auto& [off, passes] : {std::pair{0.0, true}, {1e-13, true}, {4e-13, false}}) {
    ContourBuilder b(2, {0, 0, 0});
    b.block(Mode::cut, unlimited);
    b.line({15, 0, 0});
    b.arc({15 + radius, radius, 0}, {15, radius, 0}, true);
    Case c{path_of(b), {}, {}};
    const double begin = (*c.path)[1].s0(), end = (*c.path)[1].s1(), middle = (begin + end) / 2,
                 time = (middle - begin) / speed;
    c.law.append({0, time, begin, middle, speed, 0, 0, 1});
    c.law.append({0, time, middle, end, speed, 0, 0, 1});
    TimeLaw shifted;
    shifted.append({0, time, begin, middle, speed, 0, 0, 1});
    shifted.append({0, time, middle + off, end, speed, 0, 0, 1});
    const PathMotion coarse(c.path, std::move(shifted));
    Progress progress;
    const auto checks = coarse_fine_checks({*c.path, c.law, coarse, c.coarse_axes, c.fine_axes}, progress);
    EXPECT_EQ(find(checks, "coarse continuity of velocity").passed, passes) << off;
  }
}

/// A line of 60 mm through zero: what is next to it comes from points 30 mm away.
TEST(CoarseFineChecks, NextToZeroCoarseAxesHaveTheRoundingOfTheLinesEnds) {
  for (const auto& [off, passes] : {std::pair{0.0, true}, {2e-14, true}, {1e-11, false}}) {
    ContourBuilder b(2, {-30, 0, 0});
    b.block(Mode::cut, unlimited);
    b.line({30, 0, 0});
    Case c{path_of(b), {}, {}};
    c.law.append({0, 0.3, 0, 30, 0, 2000.0 / 3, 0, 0});
    c.law.append({0, 0.3, 30, 60, 200, -2000.0 / 3, 0, 0});
    c.coarse = {{0.3, {{0}, {0}}}, {0.6, {{off}, {0}}}};
    EXPECT_EQ(find(c.checks(), "coarse continuity of position").passed, passes) << off;
  }
}

TEST(CoarseFineChecks, AxesHaveToFitTogether) {
  Case c = line();
  c.fine_axes.pop_back();
  EXPECT_THROW(c.checks(), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
