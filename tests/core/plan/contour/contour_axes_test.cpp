// Machines along a contour: every plan is verified by forward kinematics and keeps its bound.
#include "core/plan/contour/contour_axes.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <sstream>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/contour/gcode.hpp"
#include "core/machine/linear_delta.hpp"
#include "core/machine/linear_machine.hpp"
#include "core/machine/polar_machine.hpp"
#include "core/machine/rotary_delta.hpp"
#include "core/machine/scara_machine.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/check_names.hpp"
#include "tests/source.hpp"

namespace bahnwerk {
namespace {

constexpr double degree = std::numbers::pi / 180;

AxisLimits axis(const char* name, double velocity, double acceleration, double jerk, bool rotary = false) {
  const double unit = rotary ? degree : 1;
  AxisLimits limits(name, unit * velocity, unit * acceleration, unit * jerk);
  if (rotary) limits.unit = "rad";
  return limits;
}
AxisLimits height() { return axis("z", 300, 4000, 2e5); }

using Configurations = std::vector<std::shared_ptr<const Kinematics>>;

ToolMachine corexy() {
  return {Configurations{std::make_shared<const LinearMachine>(
              std::vector{axis("A", 900, 12000, 6e5), axis("B", 900, 12000, 6e5), height()},
              std::vector<Vec>{{1, 1, 0}, {1, -1, 0}, {0, 0, 1}}, 3)},
          0.001, 3};
}
ToolMachine skewed() {
  return {Configurations{std::make_shared<const LinearMachine>(
              std::vector{axis("A", 900, 12000, 6e5), axis("B", 900, 12000, 6e5), axis("C", 300, 4000, 2e5)},
              std::vector<Vec>{{1, 0.05, 0}, {0, 1, 0}, {0.01, -0.02, 1}}, 3)},
          0.001, 3};
}
ToolMachine polar() {
  return {Configurations{std::make_shared<const PolarMachine>(
              PolarSizes{{60, -60, 0}, 10},
              std::vector{axis("theta", 360, 3600, 180000, true), axis("r", 600, 6000, 3e5), height()})},
          0.001, 3};
}
ToolMachine scara() {
  Configurations arms;
  for (const bool right : {true, false})
    arms.push_back(std::make_shared<const ScaraMachine>(
        ScaraSizes{{60, -120, 0}, 200, 160, degree, right},
        std::vector{axis("theta1", 400, 4000, 2e5, true), axis("theta2", 600, 6000, 3e5, true), height()}));
  return {arms, 0.001, 3};
}
ToolMachine columns() {
  return {Configurations{std::make_shared<const LinearDelta>(
              LinearDeltaSizes{{60, 40, 0}, 150, 420, 10 * degree},
              std::vector{axis("A", 500, 8000, 4e5), axis("B", 500, 8000, 4e5), axis("C", 500, 8000, 4e5)})},
          0.001, 3};
}
ToolMachine arms() {
  return {Configurations{std::make_shared<const RotaryDelta>(
              RotaryDeltaSizes{{60, 40, 300}, 100, 150, 360, 5 * degree},
              std::vector{axis("theta1", 500, 9000, 450000, true), axis("theta2", 500, 9000, 450000, true),
                          axis("theta3", 500, 9000, 450000, true)})},
          0.001, 3};
}

struct Named {
  const char* name;
  ToolMachine (*make)();
};
class Machines : public ::testing::TestWithParam<Named> {};
INSTANTIATE_TEST_SUITE_P(All, Machines,
                         ::testing::Values(Named{"corexy", corexy}, Named{"linear", skewed}, Named{"polar", polar},
                                           Named{"scara", scara}, Named{"linear_delta", columns},
                                           Named{"rotary_delta", arms}),
                         [](const auto& each) { return std::string(each.param.name); });

/// Lines, arcs, a polynomial, a dwell.
Contour plate() {
  ContourBuilder b(2, {20, 10, 0});
  b.block(Mode::cut, 250);
  b.line({90, 10, 0});
  b.arc({90, 30, 0}, {90, 20, 0}, true);
  b.dwell(0.05);
  b.line({50, 30, 0});
  b.block(Mode::position, unlimited);
  b.line({30, 60, 0});
  b.block(Mode::cut, 400);
  b.polynomial({{30, 40, -10, 5}, {60, -20, 30, -10}});
  return b.finish();
}
Contour helix() {
  ContourBuilder b(3, {80, 20, 10});
  b.block(Mode::position, unlimited);
  b.line({80, 40, 0});
  b.block(Mode::cut, 300);
  b.arc({80, 40, -3}, {60, 40, 0}, true, {0, 0, 1});
  b.line({60, 60, -3});
  return b.finish();
}
Contour lettering() {
  std::ifstream file(test::source("examples/parts/lettering.ngc"));
  std::stringstream text;
  text << file.rdbuf();
  return read_gcode(text.str());
}

ContourPlan verified(Contour contour, const ToolMachine& machine, PlanningMethod method, double tolerance = 0) {
  ContourPlanning planning;
  planning.method = method;
  if (tolerance > 0) planning.corner_mode = CornerMode::blend, planning.blend_tolerance = tolerance;
  ContourPlan p = plan_contour(std::move(contour), machine, planning);
  EXPECT_TRUE(p.verification.passed);
  for (const Check& check : p.verification.checks)
    EXPECT_TRUE(check.passed) << check_name(check) << ' ' << check.value << " against " << check.limit << " at "
                              << check.at;
  EXPECT_GE(p.bound.gap, 0);
  std::printf("%.6f s, gap %.2g\n", p.duration, p.bound.gap);
  return p;
}

TEST_P(Machines, PlansOfEveryMethodAreVerifiedAndBounded) {
  const ToolMachine machine = GetParam().make();
  for (const auto& make : {plate, helix}) {
    const ContourPlan fast = verified(make(), machine, PlanningMethod::time_optimal);
    EXPECT_LT(fast.bound.gap, 2e-5);
    EXPECT_GE(verified(make(), machine, PlanningMethod::braking_reserve).duration, fast.duration * (1 - 1e-6));
    EXPECT_GE(verified(make(), machine, PlanningMethod::jerk_limited).duration, fast.duration);
  }
}

TEST_P(Machines, RoundedCornersAndLetteringAreVerified) {
  const ToolMachine machine = GetParam().make();
  const double stopping = verified(plate(), machine, PlanningMethod::time_optimal).duration;
  EXPECT_LE(verified(plate(), machine, PlanningMethod::time_optimal, 0.1).duration, stopping);
  verified(plate(), machine, PlanningMethod::jerk_limited, 0.1);
  verified(lettering(), machine, PlanningMethod::time_optimal);
}

TEST_P(Machines, SetpointsHoldAxesAndTool) {
  const ToolMachine machine = GetParam().make();
  const ContourPlan p = verified(helix(), machine, PlanningMethod::time_optimal);
  std::vector<std::string> names;
  for (const Column& column : p.setpoints->columns()) names.push_back(column.name);
  for (const AxisLimits& each : machine.axes) {
    const auto at = std::find(names.begin(), names.end(), each.name);
    ASSERT_NE(at, names.end());
    EXPECT_EQ(p.setpoints->columns()[static_cast<std::size_t>(at - names.begin())].unit,
              each.unit == "rad" ? "deg" : "mm");
  }
  std::vector<double> row(names.size());
  p.setpoints->read(p.setpoints->count() - 1, 1, row.data());
  const std::vector<double> end{60, 60, -3};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name(1, "xyz"[i]);
    const auto at = std::find(names.begin(), names.end(), name);
    ASSERT_NE(at, names.end());
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1);
    EXPECT_NEAR(row[static_cast<std::size_t>(at - names.begin())], end[i], 1e-9);
  }
}

/// The plate turned by 45° with what corexy makes of it: A/√2 and B/√2 are its coordinates.
TEST(ContourAxes, CoreXyIsATurnedCartesianMachine) {
  const double r = std::sqrt(0.5);
  const auto turned = [&](Vec p) { return Vec{r * (p.x + p.y), r * (p.x - p.y), p.z}; };
  ContourBuilder b(2, turned({20, 10, 0}));
  b.block(Mode::cut, 250);
  b.line(turned({90, 10, 0}));
  b.arc(turned({90, 30, 0}), turned({90, 20, 0}), false);  // the map is a reflection
  b.dwell(0.05);
  b.line(turned({50, 30, 0}));
  b.block(Mode::position, unlimited);
  b.line(turned({30, 60, 0}));
  b.block(Mode::cut, 400);
  b.polynomial({{r * 90, r * 20, r * 20, r * -5}, {r * -30, r * 60, r * -40, r * 15}});
  const Contour image = b.finish();
  const Machine cartesian{{axis("x", 900 * r, 12000 * r, 6e5 * r), axis("y", 900 * r, 12000 * r, 6e5 * r), height()},
                          0.001};
  for (const double tolerance : {0.0, 0.1})
    for (const PlanningMethod method :
         {PlanningMethod::time_optimal, PlanningMethod::braking_reserve, PlanningMethod::jerk_limited}) {
      const ContourPlan a = verified(plate(), corexy(), method, tolerance),
                        c = verified(image, cartesian, method, tolerance);
      EXPECT_NEAR(a.duration / c.duration, 1, 1e-9);
      const double iterated = method == PlanningMethod::jerk_limited ? 1e-7 : 1e-9;  // the dual of limited jerk
      EXPECT_NEAR(a.bound.value / c.bound.value, 1, iterated);
    }
}

TEST(ContourAxes, AMatrixOfOnesIsTheCartesianMachine) {
  const std::vector axes{axis("A", 900, 12000, 6e5), axis("B", 700, 9000, 6e5)};
  const ToolMachine machine{
      Configurations{std::make_shared<const LinearMachine>(axes, std::vector<Vec>{{1, 0, 0}, {0, 1, 0}}, 2)}, 0.001, 2};
  const ContourPlan a = verified(plate(), machine, PlanningMethod::time_optimal),
                    c = verified(plate(), Machine{axes, 0.001}, PlanningMethod::time_optimal);
  EXPECT_EQ(a.duration, c.duration);
  EXPECT_EQ(a.bound.value, c.bound.value);
}

TEST(ContourAxes, ChecksAreInTheUnitsOfTheAxes) {
  const ContourPlan p = verified(plate(), polar(), PlanningMethod::time_optimal);
  const Check* check = p.verification.find(quantity::axis, 1, "theta");
  ASSERT_NE(check, nullptr);
  EXPECT_EQ(check->unit, "deg");
  EXPECT_NEAR(check->limit, 360, 1e-9);
  const ContourPlan xy = verified(plate(), corexy(), PlanningMethod::time_optimal);
  check = xy.verification.find(quantity::axis, 2, "A");
  ASSERT_NE(check, nullptr);
  EXPECT_NEAR(check->limit, 12000, 1e-9);
  EXPECT_GT(check->value, 11000);
}

TEST(ContourAxes, PlacesOutOfReachAreNamed) {
  ContourBuilder b(2, {100, 0, 0});
  b.block(Mode::cut, 100);
  b.line({100, -60, 0});
  b.line({20, -60, 0});  // through the table's axis
  try {
    plan_contour(b.finish(), polar());
    FAIL();
  } catch (const UnreachablePose& e) {
    EXPECT_NEAR(e.path_length, 100, 15);
    EXPECT_NEAR(e.pose[0], 60, 15);
  }
}

TEST(ContourAxes, RangesAreKept) {
  AxisLimits theta = axis("theta", 360, 3600, 180000, true), r = axis("r", 600, 6000, 3e5);
  r.highest = 100;
  const ToolMachine machine{
      Configurations{std::make_shared<const PolarMachine>(PolarSizes{{60, -60, 0}, 10}, std::vector{theta, r})}, 0.001,
      2};
  EXPECT_THROW(plan_contour(plate(), machine), UnreachablePose);
}

/// A table that goes round and round.
TEST(ContourAxes, TurnsOfATableAddUp) {
  ContourBuilder b(2, {100, 0, 0});
  b.block(Mode::cut, 500);
  for (int i = 0; i < 3; ++i) b.arc({100, 0, 0}, {}, true);
  const ToolMachine machine{
      Configurations{std::make_shared<const PolarMachine>(
          PolarSizes{}, std::vector{axis("theta", 360, 3600, 180000, true), axis("r", 600, 6000, 3e5)})},
      0.001, 2};
  const ContourPlan p = verified(b.finish(), machine, PlanningMethod::time_optimal);
  std::vector<double> first(p.setpoints->columns().size()), last(first);
  p.setpoints->read(0, 1, first.data());
  p.setpoints->read(p.setpoints->count() - 1, 1, last.data());
  EXPECT_NEAR(last[0] - first[0], -3 * 360, 1e-6);
}

}  // namespace
}  // namespace bahnwerk
