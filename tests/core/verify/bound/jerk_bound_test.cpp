// The bound under limits of jerk: below everything that can be driven, and close to it.
#include "core/verify/bound/jerk_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/verify/bound/bound_solver.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "tests/core/motion/axes/five_axes.hpp"
#include "tests/core/motion/reference/jerk_curves.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk {
namespace {

using reference::Maker;

constexpr double corner_angle = 0.1 * std::numbers::pi / 180;

Machine machine(double jerk, std::size_t axes = 2) {
  Machine m = reference::machine(axes, 1800, 16000);
  for (AxisLimits& axis : m.axes) axis.jerk = jerk;
  return m;
}

double bound(const Contour& contour, const Machine& m, double corner = corner_angle) {
  Progress silent;
  return lower_bound(contour, m, corner, silent).value;
}

double planned(const Contour& contour, const Machine& m) {
  Progress silent;
  JerkLimitedOptions options;
  options.corner_angle = corner_angle;
  return plan_jerk_limited(contour, m, options, silent).law.duration();
}

TEST(JerkBound, LinesInPartsStayBelowTheClosedForm) {
  for (const double way : {0.01, 1.0, 100.0, 3000.0})
    for (const double jerk : {1e4, 1e6, 1e8}) {
      const double exact = bound(Maker().line({way, 0}).done(), machine(jerk));  // one part: closed form
      const double parts = bound(Maker().line({0.3 * way, 0}).line({way, 0}).done(), machine(jerk));
      EXPECT_LE(parts, exact) << way << ' ' << jerk;
      EXPECT_GE(parts, exact * (1 - 3e-3)) << way << ' ' << jerk;
    }
}

TEST(JerkBound, IsCloseToTheDirectSolutions) {
  for (const reference::JerkCurve& curve : reference::jerk_curves()) {
    const double expected = curve.expected(), found = bound(curve.contour, curve.machine);
    EXPECT_LE(found, expected * (1 + 1e-3)) << curve.text;  // the reference's own error
    EXPECT_GE(found, expected * (1 - 0.03)) << curve.text;
  }
}

std::vector<Contour> contours() {
  std::vector<Contour> list;
  list.push_back(Maker().line({40, 0}).arc({60, 20}, {40, 20}, true).line({60, 45}).done());
  list.push_back(Maker().bezier({{30, 40}, {60, -40}, {80, 20}}).done());
  list.push_back(Maker().block(300).bezier({{30, 40}, {60, -40}, {80, 20}}).done());
  list.push_back(Maker().line({10, 0}).line({20, 0.01}).line({30, 0}).done());  // small kinks
  return list;
}

TEST(JerkBound, StaysBelowThePlanAndCloseToIt) {
  for (const Contour& contour : contours())
    for (const double jerk : {1e5, 1e6, 1e7}) {
      const double low = bound(contour, machine(jerk)), plan = planned(contour, machine(jerk));
      EXPECT_LE(low, plan * (1 + 1e-9)) << jerk;
      EXPECT_GE(low, plan * (1 - 0.04)) << jerk;
    }
}

// A long section is bounded in windows. Their ends cost next to nothing: every round of a circle that is driven at two
// feeds takes as long as one more of a few.
TEST(JerkBound, LosesNextToNothingBetweenWindows) {
  const auto circle = [](int rounds) {
    Maker maker;
    for (int i = 0; i < rounds; ++i) maker.block(400).arc({0, 20}, {0, 10}, true).block(200).arc({0, 0}, {0, 10}, true);
    return maker.done();
  };
  const auto low = [&](int rounds) { return bound(circle(rounds), machine(1e6)); };
  const double few = low(12), many = low(60), round = few - low(11);
  EXPECT_NEAR(many - few, 48 * round, 1e-3 * many);
  EXPECT_LE(many, planned(circle(60), machine(1e6)));
}

// A right angle rounded within 0.02 mm between lines, as blends do it: by the relaxation alone the bound is 4 to 5 %
// low, because time may pass there without moving; with the caps and cells of long sections 0.9 to 1.0 %.
TEST(JerkBound, IsCloseAtRoundedCorners) {
  const double d = 0.081, l = 0.947;
  const auto at = [&](double part) { return 1 - part * l * 2 / 7; };
  Maker maker;
  maker.line({7 - d, 0})
      .bezier({{7 - d * at(1), 0},
               {7 - d * at(2), 0},
               {7 - d * at(3), 0},
               {7, d * at(3)},
               {7, d * at(2)},
               {7, d * at(1)},
               {7, d}});
  const Contour contour = maker.line({7, 7}).done();
  for (const double jerk : {1e5, 1e6, 1e7}) {
    const double low = bound(contour, machine(jerk)), plan = planned(contour, machine(jerk));
    EXPECT_LE(low, plan * (1 + 1e-9)) << jerk;
    EXPECT_GE(low, plan * (1 - 0.008)) << jerk;
  }
}

// There a difference of coordinates has few digits: what they may be wrong by must not make the bound longer.
TEST(JerkBound, IsNoLongerFarFromTheOrigin) {
  for (const double away : {1e4, 1e6, 9.9e6})
    for (const double size : {0.01, 0.1, 1.0})
      for (const double jerk : {1e5, 8e5, 1e7}) {
        const auto shape = [&](const Vec& from) {
          const auto to = [&](double x, double y) { return from + Vec{size * x, size * y, 0}; };
          return Maker(2, from)
              .bezier({to(0.6, 0), to(0.9, 0.7), to(1, 1)})
              .bezier({to(1.05, 1.15), to(1.3, 1.2), to(1.6, 0.8)})
              .done();
        };
        Machine m = machine(jerk);
        m.cycle_time = 1e-5;
        const double here = bound(shape({}), m), there = bound(shape({-away, away, 0}), m);
        EXPECT_LE(there, here * (1 + 1e-5)) << away << ' ' << size << ' ' << jerk;
        const double known = away > 1e4 || size < 0.05 ? 0 : 0.98;
        EXPECT_GE(there, here * known) << away << ' ' << size << ' ' << jerk;
      }
}

TEST(JerkBound, KnowsMoreThanTheBoundWithoutJerk) {
  for (const Contour& contour : contours()) {
    const double without = bound(contour, machine(unlimited));
    double before = unlimited;
    for (const double jerk : {1e5, 1e6, 1e7, 1e8}) {
      const double now = bound(contour, machine(jerk));
      EXPECT_GE(now, without);
      EXPECT_LE(now, before * (1 + 2e-3)) << jerk;  // on another grid for each jerk
      before = now;
    }
    EXPECT_GT(bound(contour, machine(1e5)), 1.02 * without);
  }
}

// An arc after a line: at the joint the acceleration may step by jerk · cycle time only, so that the speed there is
// limited whatever the rest does.
TEST(JerkBound, SlowsWhereCurvatureJumps) {
  const Contour contour = Maker().line({200, 0}).arc({200, 20}, {200, 10}, true).line({0, 20}).done();
  const double speed = std::sqrt(1e6 * 0.001 * 10);  // κ v² = J · cycle
  // Twice from the joint to the line's other end with a full brake, and half the circle in between at best.
  const double brake = (std::sqrt(2 * 16000 * 100 + speed * speed / 2) * 2 - speed) / 16000;
  EXPECT_GE(bound(contour, machine(1e6)), 2 * brake);
  EXPECT_LE(bound(contour, machine(1e6)), planned(contour, machine(1e6)));
}

// Where curvature jumps an axis steps by Δq″ v², no more and not the other way. Steps of either sign up to that size,
// all that the verifier's limit alone would tell, would leave a gap of 0.9 %.
TEST(JerkBound, KnowsTheStepsOfAcceleration) {
  Maker spiral;
  const double sweep = std::numbers::pi / 9;
  double x = 0, y = 0, angle = -std::numbers::pi / 2;  // angle: from the centre to the head
  for (int i = 0; i < 60; ++i) {
    const double r = 5 + i / 9.0, cx = x - r * std::cos(angle), cy = y - r * std::sin(angle);
    angle += sweep;
    x = cx + r * std::cos(angle), y = cy + r * std::sin(angle);
    spiral.arc({x, y}, {cx, cy}, true);
  }
  const Contour contour = spiral.done();
  const double low = bound(contour, machine(1e5)), plan = planned(contour, machine(1e5));
  EXPECT_LE(low, plan);
  EXPECT_GE(low, plan * (1 - 3e-3));
}

// Where the step of acceleration that a cycle allows holds a joint down, the speed beside it follows from it, however
// large the acceleration and the cells beside it are. With the cap of whole cells there the gaps were 3.7 and 24 %.
TEST(JerkBound, KnowsHowSlowlyAJumpOfCurvatureIsPassed) {
  for (const double feed : {25.0, 200.0}) {
    const double r = 24, t = 1.1 / r, q = 2.2, u = 2.1 / q;
    const double x = r * std::sin(t), y = r * (1 - std::cos(t));
    const double cx = x + q * std::sin(t), cy = y - q * std::cos(t);
    Maker two;
    two.block(feed)
        .arc({x, y}, {0, r}, true)
        .arc({cx - q * std::sin(t - u), cy + q * std::cos(t - u)}, {cx, cy}, false);
    const Contour contour = two.done();
    const double low = bound(contour, machine(1e5)), plan = planned(contour, machine(1e5));
    EXPECT_LE(low, plan) << feed;
    EXPECT_GE(low, plan * (1 - 8e-3)) << feed;
  }
}

TEST(JerkBound, ScalesWithTime) {
  const Contour contour = contours()[1];
  Machine fast = machine(1e6);
  for (AxisLimits& axis : fast.axes) axis.velocity *= 2, axis.acceleration *= 4, axis.jerk *= 8;
  fast.cycle_time /= 2;
  EXPECT_NEAR(2 * bound(contour, fast), bound(contour, machine(1e6)), 1e-6);
}

// A motion changes its speed within √(v/J): at a small feed, or where jerk is small, that is far less than the time in
// which jerk builds up the acceleration.
TEST(JerkBound, ResolvesChangesOfSpeedThatJerkAloneLimits) {
  for (const double feed : {5.0, 25.0, unlimited})
    for (const double way : {0.1, 1.0, 10.0}) {
      const double exact = bound(Maker().block(feed).line({way, 0}).done(), machine(1e4));  // one part: closed form
      const double parts = bound(Maker().block(feed).line({0.3 * way, 0}).line({way, 0}).done(), machine(1e4));
      EXPECT_LE(parts, exact) << feed << ' ' << way;
      EXPECT_GE(parts, exact * (1 - 2e-3)) << feed << ' ' << way;
    }
}

// What a piece is worth less for rounding grows as it shrinks: on cells that are too short for a piece of their own
// nothing of that is lost.
TEST(JerkBound, LosesNothingToRoundingOnVeryShortCells) {
  const Contour contour = Maker().line({300, 0}).bezier({{300.1, 0}, {300.2, 0}, {300.3, 0.2}, {300.3, 0.3}}).done();
  const Machine m = machine(1e6);
  Progress silent;
  ProgressScope progress(silent, "bound");
  const CartesianAxisPath path(contour.path, 2);
  verify::BoundGrid<2> grid(path, m, contour_task(path, contour, m).feeds, corner_angle, progress);
  verify::BoundSolver<2> solver(grid, progress);
  verify::JerkBound<2> jerk(grid, m, progress);
  grid.build(0, path.size());
  const auto duration = [&] {
    solver.solve();
    return jerk.duration(solver.speed_squares(grid.order().size()), solver.duration(), true, true);
  };
  const double coarse = duration();
  for (int round = 0; round < 6; ++round) {
    std::vector<unsigned char> all(grid.order().size() - 1, 1);
    all[0] = 0;  // the long line
    grid.refine(all);
  }
  const double fine = duration();
  EXPECT_NEAR(fine, coarse, 3e-4 * coarse);
}

TEST(JerkBound, LongSectionsAreCutIntoWindowsAndStayBelow) {
  Maker maker;
  for (int i = 0; i < 300; ++i) {
    const double x = 20.0 * i;
    maker.bezier({{x + 5, 4}, {x + 5, 4}, {x + 10, 0}}).bezier({{x + 15, -4}, {x + 15, -4}, {x + 20, 0}});
  }
  const Contour contour = maker.done();
  const Machine m = machine(1e7);
  const double low = bound(contour, m), plan = planned(contour, m);
  EXPECT_LE(low, plan * (1 + 1e-9));
  EXPECT_GE(low, plan * (1 - 0.02));
}

TEST(JerkBound, HoldsForFiveAxes) {
  const test::FiveAxes kinematics;
  const Machine m{kinematics.axes(), 0.001};
  Progress silent;
  for (const Contour& contour : contours()) {
    const KinematicAxisPath path(contour.path, kinematics);
    const PathTask task = contour_task(path, contour, m);
    const double low = lower_bound(task, corner_angle, silent).value;
    const double plan = plan_jerk_limited(task, {}, silent).law.duration();
    EXPECT_LE(low, plan * (1 + 1e-9));
    EXPECT_GE(low, plan * (1 - 0.06));
  }
}

}  // namespace
}  // namespace bahnwerk
