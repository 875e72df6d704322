// The picture of docs/methods/contour_machines.md: machines along the bracket.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/machine/polar_machine.hpp"
#include "core/machine/scara_machine.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "docs/draw/chart.hpp"
#include "docs/draw/colours.hpp"
#include "docs/draw/map.hpp"
#include "docs/draw/pictures.hpp"
#include "docs/draw/shapes.hpp"

namespace bahnwerk::draw {
namespace {

constexpr double degree = std::numbers::pi / 180;

AxisLimits rotary(const char* name, double velocity, double acceleration) {
  AxisLimits axis(name, degree * velocity, degree * acceleration);
  axis.unit = "rad";
  return axis;
}

ContourPlan fastest(const ToolMachine& machine) {
  ContourPlanning planning;
  planning.method = PlanningMethod::time_optimal;
  return plan_contour(bracket(), machine, planning);
}

/// The arms of examples/bracket_scara.json at even times.
Chart arms() {
  const ScaraSizes sizes{{60, -120, 0}, 200, 160, degree, true};
  const auto machine = std::make_shared<const ScaraMachine>(
      sizes, std::vector{rotary("theta1", 400, 4000), rotary("theta2", 600, 6000)});
  const ContourPlan plan = fastest(ToolMachine({machine}, 0.001, 2));
  Chart chart({"SCARA: the arms of examples/bracket_scara.json, right elbow",
               "x, mm",
               "y, mm",
               {-20, 270},
               {-130, 95},
               800,
               0,
               true});
  constexpr int shown = 12;
  for (int i = 0; i < shown; ++i) {
    const MotionState at = plan.motion->evaluate(plan.motion->duration() * i / shown);
    const double t1 = at[0][0], both = t1 + at[0][1];
    const Point shoulder{sizes.origin.x, sizes.origin.y},
        elbow{shoulder.x + sizes.l1 * std::cos(t1), shoulder.y + sizes.l1 * std::sin(t1)},
        tool{elbow.x + sizes.l2 * std::cos(both), elbow.y + sizes.l2 * std::sin(both)};
    chart.line({shoulder, elbow}, {"#8a919b", 3, "", 0.6, true}, i == 0 ? "upper arm" : "");
    chart.line({elbow, tool}, {"#d9730d", 2, "", 0.6, true}, i == 0 ? "lower arm" : "");
  }
  plain(chart, bracket(), {"#1f5fbf", 2, "", 1, true}, "contour");
  return chart;
}

/// How fast table and tool are on the window of the bracket.
Chart table() {
  const auto machine = std::make_shared<const PolarMachine>(
      PolarSizes{{60, -60, 0}, 10}, std::vector{rotary("theta", 360, 3600), AxisLimits("r", 600, 6000)});
  ContourPlanning planning;
  planning.method = PlanningMethod::time_optimal;
  const ContourPlan plan = plan_contour(window(), ToolMachine({machine}, 0.001, 2), planning);
  Line theta, r;
  constexpr int shown = 800;
  const double duration = plan.motion->duration();
  for (int i = 0; i <= shown; ++i) {
    const double t = duration * i / shown;
    const MotionState at = plan.motion->evaluate(t);
    theta.push_back({t, std::abs(at[2][0]) / (3600 * degree)});
    r.push_back({t, std::abs(at[2][1]) / 6000});
  }
  Chart chart({"Polar machine: use of the axes' accelerations on the bracket's free-form window",
               "t, s",
               "share of the limit",
               {0, duration},
               {0, 1.1},
               800,
               300,
               false,
               24,
               "table"});
  chart.line(theta, blue, "theta");
  chart.line(r, orange, "r");
  return chart;
}

}  // namespace

void machines_along_the_bracket(const std::string& file) { Chart::save(file, {arms(), table()}); }

}  // namespace bahnwerk::draw
