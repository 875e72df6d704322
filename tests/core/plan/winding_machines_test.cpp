// The pipeline along a needle's path in five coordinates, on the three winding machines.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/geometry/curve/reversed.hpp"
#include "core/motion/axes/machine_path.hpp"
#include "core/plan/path_plan.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/machine/winders.hpp"
#include "tests/core/motion/axes/needle_loop.hpp"

namespace bahnwerk {
namespace {

PathPlanning planning_of(const MachinePath& machine, const Path& tool, PlanningMethod method) {
  PathPlanning planning;
  planning.path = planning.moving = machine.axes;
  planning.method = method_row(method);
  planning.machine = held_limits({machine.kinematics->axes(), 0.002}, planning.method);
  planning.feeds = planning.feeds_to_verify = std::vector<double>(tool.size(), unlimited);
  planning.rests = std::vector<bool>(tool.size() + 1, false);
  planning.rests.front() = planning.rests.back() = true;
  return planning;
}

/// With limits along the path, and those of the axes as if they had `looser` times the time.
PathPlan plan(const MachinePath& machine, const Path& tool, PlanningMethod method, const Limits& along = {},
              double looser = 1) {
  PathPlanning planning = planning_of(machine, tool, method);
  for (AxisLimits& axis : planning.machine.axes)
    axis.velocity *= looser, axis.acceleration *= looser * looser, axis.jerk *= looser * looser * looser;
  planning.options.along = along;
  Progress progress;
  return plan_along(planning, progress);
}

void expect_verified(const PathPlan& p, const std::string& what) {
  for (const Check& check : p.verification.checks)
    EXPECT_TRUE(check.passed) << what << ": " << check_name(check) << ' ' << check.value << " against " << check.limit
                              << " at " << check.at;
  EXPECT_TRUE(p.verification.passed) << what;
}

/// Forward kinematics of every setpoint lies on the needle's path.
void expect_on_path(const PathPlan& p, const MachinePath& machine, const std::string& what) {
  const SetpointSource& rows = *p.setpoints;
  const std::size_t columns = rows.columns().size();
  ASSERT_EQ(columns, 17u);
  std::vector<double> all(rows.count() * columns);
  rows.read(0, rows.count(), all.data());
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const double* row = all.data() + columns * i;
    const ToolPose pose = machine.kinematics->forward({row[0], row[1], row[2], row[3], row[4]});
    const std::size_t segment = machine.axes->tool().find(row[15]);
    const ToolPose wanted = machine.axes->pose(segment, machine.axes->tool()[segment].parameter(row[15]));
    ASSERT_LE(norm(pose.position - wanted.position), 1e-6) << what << ' ' << i;
    ASSERT_LE(std::abs(std::remainder(pose.phi - wanted.phi, 2 * std::numbers::pi)), 1e-8) << what << ' ' << i;
    ASSERT_LE(std::abs(pose.psi - wanted.psi), 1e-8) << what << ' ' << i;
  }
}

TEST(WindingMachines, OneTurnIsPlannedAndVerifiedOnEachOfThem) {
  const test::NeedlePath path = test::stator_turn();
  for (const test::Winder& winder : test::winders()) {
    const MachinePath machine = machine_path(path.tool, path.orientation, winder.configurations);
    const PathPlan fast = plan(machine, path.tool, PlanningMethod::time_optimal),
                   smooth = plan(machine, path.tool, PlanningMethod::jerk_limited);
    expect_verified(fast, winder.name + " time_optimal");
    expect_verified(smooth, winder.name + " jerk_limited");
    expect_on_path(smooth, machine, winder.name);
    EXPECT_GE(smooth.duration, fast.duration * (1 - 1e-9)) << winder.name;
    EXPECT_LE(fast.bound.gap, 1e-4) << winder.name;
    EXPECT_LE(smooth.bound.value, smooth.duration) << winder.name;
    EXPECT_LE(smooth.bound.gap, 0.013) << winder.name;
    std::printf("%s: %.4f s (gap %.2g), jerk %.4f s (gap %.2g)\n", winder.name.c_str(), fast.duration, fast.bound.gap,
                smooth.duration, smooth.bound.gap);
  }
}

/// Limits of axes do not know which way time runs, through kinematics neither.
TEST(WindingMachines, BackwardsAPathTakesAsLong) {
  using CurvePointer = std::shared_ptr<const Curve>;
  const auto angles = [](double phi, double psi) {
    return std::make_shared<Rational>(
        Rational::from_power_basis({{0, 0, 0, 10 * phi, -15 * phi, 6 * phi}, {0, 0, 0, 10 * psi, -15 * psi, 6 * psi}}));
  };
  const auto still = std::make_shared<Rational>(Rational::from_power_basis({{0, 0}, {0, 0}}));
  // Up a slot, and half over the winding head while the needle swivels.
  const std::vector<std::pair<CurvePointer, CurvePointer>> pieces{
      {std::make_shared<Line>(Vec{80, 0, 0}, Vec{80, 0, 110}), still},
      {std::make_shared<Rational>(
           Rational::bezier({{80, 0, 110}, {80, 0, 118}, {80, 0, 126}, {78, 14, 140}, {74, 30, 140}})),
       angles(0.39, 1.1)}};
  test::NeedleMaker forward, backward;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& [curve, turned] = pieces[i];
    forward.append(curve, turned);
    const auto& [last, last_turned] = pieces[pieces.size() - 1 - i];
    backward.append(reversed(*last), reversed(*last_turned));
  }
  const test::NeedlePath there = forward.done(), back = backward.done();
  for (const test::Winder& winder : test::winders())
    for (const PlanningMethod method :
         {PlanningMethod::time_optimal, PlanningMethod::braking_reserve, PlanningMethod::jerk_limited}) {
      const std::string what = winder.name + ", method " + std::to_string(static_cast<int>(method));
      const PathPlan a = plan(machine_path(there.tool, there.orientation, winder.configurations), there.tool, method),
                     b = plan(machine_path(back.tool, back.orientation, winder.configurations), back.tool, method);
      expect_verified(a, what);
      expect_verified(b, what + " backwards");
      EXPECT_NEAR(b.duration, a.duration, (method == PlanningMethod::jerk_limited ? 1e-3 : 1e-5) * a.duration) << what;
    }
}

/// The swivel holds the needle between −90° and 90°; its range is not met a whole turn away from that.
TEST(WindingMachines, AnotherTurnOfTheSwivelIsOutOfReach) {
  const test::NeedlePath path = test::stator_turn();
  const auto swivelling = [](double lowest, double highest) {
    std::vector<Limits> limits = test::horizontal_limits();
    limits[4] = test::rotary(720, 7000, 180000, lowest, highest);
    return std::make_shared<const HorizontalWinder>(HorizontalWinderSizes{}, limits);
  };
  EXPECT_NO_THROW(machine_path(path.tool, path.orientation, {swivelling(-100, 100)}));
  EXPECT_THROW(machine_path(path.tool, path.orientation, {swivelling(260, 460)}), UnreachablePose);
  EXPECT_THROW(machine_path(path.tool, path.orientation, {swivelling(-7300, -7100)}), UnreachablePose);
}

/// Limits of the needle along its path, one by one and together, on a machine whose axes hold nothing up: a double-S
/// along the whole way is the shortest motion, and the bound knows it.
TEST(WindingMachines, TheBoundKnowsTheLimitsAlongThePath) {
  const test::NeedlePath path = test::stator_turn();
  const test::Winder winder = test::winders().front();
  MachinePath machine = machine_path(path.tool, path.orientation, winder.configurations);
  const double length = path.tool.length();
  const struct {
    Limits along;
    double duration;
  } cases[] = {{{20}, length / 20},
               {{unlimited, 30, 3000}, 2 * std::sqrt(length / 30) + 0.01},
               {{unlimited, unlimited, 100}, 4 * std::cbrt(length / 200)},
               {{50, 40, 60}, length / 50 + 50.0 / 40 + 40.0 / 60}};
  for (const auto& [along, duration] : cases) {
    const PathPlan p = plan(machine, path.tool, PlanningMethod::jerk_limited, along, 1e3);
    const std::string what = std::to_string(duration);
    expect_verified(p, what);
    EXPECT_NEAR(p.duration, duration, 1e-3 * duration) << what;
    EXPECT_LE(p.bound.gap, 0.002) << what;
    if (along.jerk < unlimited) {
      EXPECT_LE(p.pieces, 4000u) << what;  // the grid does not follow axes that are idle
    }
  }
}

/// One axis whose jerk is as good as unlimited costs neither the others' law nor their bound, and no time.
TEST(WindingMachines, JerkLimitsOfDifferentOrdersArePlannedLikeOthers) {
  const test::NeedlePath path = test::stator_turn();
  for (const test::Winder& winder : test::winders()) {
    const MachinePath machine = machine_path(path.tool, path.orientation, winder.configurations);
    for (std::size_t k = 0; k < 5; ++k) {
      double before = unlimited;
      for (const double times : {1.0, 1e3, 1e7}) {
        PathPlanning planning = planning_of(machine, path.tool, PlanningMethod::jerk_limited);
        planning.machine.axes[k].jerk *= times;
        Progress progress;
        const PathPlan p = plan_along(planning, progress);
        const std::string what = winder.name + ", axis " + std::to_string(k + 1) + " times " + std::to_string(times);
        expect_verified(p, what);
        EXPECT_LE(p.duration, before * (1 + 1e-3)) << what;
        EXPECT_LE(p.iterations, 100u) << what;
        EXPECT_LE(p.pieces, 5000u) << what;
        EXPECT_LE(p.bound.gap, 0.06) << what;
        before = p.duration;
      }
    }
  }
}

/// About a part that is clamped beside the axis, so that every linear axis moves, and about one on the axis, along
/// which two of them stand still but for rounding.
TEST(WindingMachines, FullTurnsArePlannedAndVerified) {
  const test::NeedlePath path = test::helix(60, 2.5, 40);
  for (const Vec origin : {Vec{4, 3, 0}, Vec{}}) {
    VerticalWinderSizes vertical;
    HorizontalWinderSizes horizontal;
    vertical.part.origin = horizontal.part.origin = origin;
    for (const std::shared_ptr<const Kinematics>& winder :
         {std::shared_ptr<const Kinematics>(std::make_shared<VerticalWinder>(vertical, test::vertical_limits())),
          std::shared_ptr<const Kinematics>(
              std::make_shared<HorizontalWinder>(horizontal, test::horizontal_limits()))}) {
      const MachinePath machine = machine_path(path.tool, path.orientation, {winder});
      const PathPlan fast = plan(machine, path.tool, PlanningMethod::time_optimal),
                     smooth = plan(machine, path.tool, PlanningMethod::jerk_limited);
      expect_verified(fast, "full turns, time_optimal");
      expect_verified(smooth, "full turns");
      EXPECT_LE(fast.bound.gap, 1e-5);
      EXPECT_LE(smooth.bound.gap, 4e-3);
      EXPECT_LE(fast.pieces, 2000u);
      expect_on_path(smooth, machine, "full turns");
      EXPECT_NEAR(machine.spans[3].highest - machine.spans[3].lowest, 5 * std::numbers::pi, 1e-9);
    }
  }
}

/// Where the strokes in the slots take one cell of a coarse grid each a long path is no slower than its turns.
TEST(WindingMachines, ManyTurnsTakeWhatOneTakes) {
  const test::NeedlePath one = test::stator_turn(), many = test::stator_turns(16);
  for (const test::Winder& winder : test::winders()) {
    const MachinePath first = machine_path(one.tool, one.orientation, winder.configurations),
                      machine = machine_path(many.tool, many.orientation, winder.configurations);
    const PathPlan single = plan(first, one.tool, PlanningMethod::jerk_limited),
                   all = plan(machine, many.tool, PlanningMethod::jerk_limited);
    expect_verified(all, winder.name);
    EXPECT_LE(all.duration, 16 * single.duration) << winder.name;
    EXPECT_LE(all.bound.gap, 0.06) << winder.name;
    EXPECT_LE(all.iterations, 150u) << winder.name;
  }
}

}  // namespace
}  // namespace bahnwerk
