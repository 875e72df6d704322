#include "core/plan/contour/contour_faults.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/contour/builder.hpp"

namespace bahnwerk {
namespace {

Contour straight(Vec end, std::size_t dimension = 2) {
  ContourBuilder builder(dimension, {0, 0, 0});
  builder.block(Mode::cut, 100);
  builder.line(end);
  return builder.finish();
}

Machine two_axes(double jerk = unlimited) {
  Machine machine;
  machine.axes = {{"x", 300, 4000, jerk}, {"y", 200, 3000, jerk}};
  return machine;
}

/// "machine/axes/z machine/cycle_time ": the places of all faults.
std::string places(const std::vector<InputFault>& faults) {
  std::string all;
  for (const InputFault& fault : faults) {
    std::string place;
    for (const std::string& part : fault.place) place += (place.empty() ? "" : "/") + part;
    all += place + " ";
  }
  return all;
}

TEST(ContourFaults, MachinesWithPositiveLimitsAreAccepted) {
  EXPECT_EQ(places(machine_faults(two_axes())), "");
  EXPECT_EQ(places(machine_faults(two_axes(1e5))), "");
}

TEST(ContourFaults, LimitsThatAreNoPositiveNumbersAreNamedByAxis) {
  Machine machine = two_axes();
  machine.axes[0].acceleration = 0;
  machine.axes[1].velocity = std::nan("");
  machine.axes[1].jerk = -1;
  EXPECT_EQ(places(machine_faults(machine)),
            "machine/axes/x/acceleration machine/axes/y/velocity machine/axes/y/jerk ");
}

TEST(ContourFaults, CycleTimeZeroAndEmptyRangesAreNamedAndSpeedNeedsNoLimit) {
  Machine machine = two_axes();
  machine.cycle_time = 0;
  machine.axes[0].velocity = unlimited;
  machine.axes[1].lowest = machine.axes[1].highest = 5;
  EXPECT_EQ(places(machine_faults(machine)), "machine/cycle_time machine/axes/y/range ");
}

TEST(ContourFaults, LimitedJerkNeedsALimitOfSomeAxisThatMoves) {
  ContourPlanning planning;
  planning.method = PlanningMethod::jerk_limited;
  EXPECT_EQ(places(planning_faults(two_axes(), planning)), "machine/axes/x/jerk ");
  EXPECT_EQ(places(planning_faults(two_axes(1e5), planning)), "");
  Machine machine = two_axes();
  machine.axes.push_back({"z", 100, 1000, 1e4});  // stands still
  EXPECT_EQ(places(planning_faults(machine, planning)), "");
  EXPECT_EQ(places(contour_faults(straight({50, 0}), machine, planning)), "machine/axes/x/jerk ");
  planning.along.jerk = 1e5;
  EXPECT_EQ(places(contour_faults(straight({50, 0}), machine, planning)), "");
}

TEST(ContourFaults, LimitsOfThePathBelongToLimitedJerk) {
  ContourPlanning planning;
  planning.along.acceleration = 500;
  EXPECT_EQ(places(planning_faults(two_axes(), planning)), "planning/path ");
}

TEST(ContourFaults, BlendingNeedsAToleranceAndStoppingHasNone) {
  ContourPlanning planning;
  planning.corner_mode = CornerMode::blend;
  EXPECT_EQ(places(planning_faults(two_axes(), planning)), "planning/corner/tolerance ");
  planning.blend_tolerance = 0.01;
  EXPECT_EQ(places(planning_faults(two_axes(), planning)), "");
  planning.corner_mode = CornerMode::stop;
  EXPECT_EQ(places(planning_faults(two_axes(), planning)), "planning/corner/tolerance ");
}

TEST(ContourFaults, EveryAxisThatTheContourMovesHasToBeThere) {
  EXPECT_EQ(places(contour_faults(straight({1, 2, 3}, 3), two_axes(), {})), "machine/axes/z ");
  Machine machine = two_axes();
  machine.axes.pop_back();
  EXPECT_EQ(places(contour_faults(straight({1, 2, 3}, 3), machine, {})), "machine/axes/y machine/axes/z ");
  EXPECT_EQ(places(contour_faults(Contour{}, two_axes(), {})), "contour ");
}

TEST(ContourFaults, ShortestTimeIsThatAtFeedOrAtFullSpeedOfAllAxes) {
  EXPECT_DOUBLE_EQ(shortest_time(straight({50, 0}), two_axes()), 0.5);
  Machine slow = two_axes();
  slow.axes[0].velocity = 3, slow.axes[1].velocity = 4;
  EXPECT_DOUBLE_EQ(shortest_time(straight({50, 0}), slow), 10);
}

TEST(ContourFaults, TooManySetpointsAreRefusedBeforeAnythingIsPlanned) {
  ContourPlanning planning;
  planning.max_setpoints = 499;  // 0.5 s in cycles of 1 ms
  EXPECT_EQ(places(contour_faults(straight({50, 0}), two_axes(), planning)), "machine/cycle_time ");
  planning.max_setpoints = 501;
  EXPECT_EQ(places(contour_faults(straight({50, 0}), two_axes(), planning)), "");
}

TEST(ContourFaults, PlanningThrowsThem) {
  Machine machine = two_axes();
  machine.axes[0].velocity = -1;
  EXPECT_THROW(plan_contour(straight({50, 0}), machine), InvalidInput);
  EXPECT_THROW(plan_contour(straight({1, 2, 3}, 3), two_axes()), InvalidInput);
  EXPECT_TRUE(plan_contour(straight({50, 0}), two_axes()).verification.passed);
}

}  // namespace
}  // namespace bahnwerk
