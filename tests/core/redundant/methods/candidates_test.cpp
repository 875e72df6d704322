#include "core/redundant/methods/candidates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/infeasible_at.hpp"
#include "core/numeric/random.hpp"
#include "core/redundant/coarse/coarse_alone.hpp"
#include "tests/core/redundant/chosen_plan.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/frames.hpp"
#include "tests/core/redundant/joint_plans.hpp"
#include "tests/core/redundant/known/known_plans.hpp"

namespace bahnwerk {
namespace {

Check check(const char* axis, double value, double limit) {
  return {{quantity::axis, 1, "mm", axis}, limit, value, 0.5, value <= limit};
}

Verification failed() {
  Verification verdict;
  verdict.add(check("xc", 12, 10));
  return verdict;
}

TEST(PlanChoice, TheCheckThatFailedByMostIsTold) {
  Verification verdict;
  verdict.add(check("x", 3, 4));
  EXPECT_FALSE(failed_by_most(verdict));
  verdict.add(check("y", 1100, 1000));
  verdict.add(check("z", 3, 2));
  EXPECT_EQ(failed_by_most(verdict)->subject, "z");
  verdict.add(check("a", 1e-9, 0));
  EXPECT_EQ(failed_by_most(verdict)->subject, "a");
  Verification lost;
  lost.add(check("x", NAN, 1));
  lost.add(check("y", 5, 1));
  EXPECT_EQ(failed_by_most(lost)->subject, "x");
}

/// A filter whose reference has to slow down for one long move is slower than the gantry by itself. Its plan is the one
/// that was asked for all the same, and both durations are told.
TEST(PlanChoice, AMethodThatIsAskedForKeepsItsOwnPlan) {
  const RedundancyTask task = test::redundancy_task(test::framed(2, {}), test::md2());
  Progress progress;
  RedundancyOptions options;
  const double alone = plan_coarse_alone(task, options, progress).head->duration();
  for (const auto& method : redundancy_methods) {
    SCOPED_TRACE(method.name);
    options.method = method.value;
    PlanChoice choice(task, options, progress);
    ASSERT_TRUE(choice.next());
    const double duration = choice.plan().head->duration();
    EXPECT_EQ(duration, test::plan(task, method.value, options).head->duration());
    EXPECT_TRUE(choice.gave_way(duration).empty());
    const bool slower = method.value == RedundancyMethod::filter || method.value == RedundancyMethod::lag_compensation;
    EXPECT_EQ(duration > alone * (1 + 1e-9), slower);
    EXPECT_EQ(choice.quicker_coarse_axes(duration).has_value(), slower);
  }
}

/// The gantry takes longer than a split of which every other section is slowed, and less than one with little stroke.
TEST(PlanChoice, TheJointPlannerIsNeverSlowerThanTheCoarseAxesAlone) {
  Progress progress;
  for (const double stroke : {0.001, 0.03, 1.0, 20.0}) {
    SCOPED_TRACE(stroke);
    CoarseFineMachine machine = test::md2();
    for (CoarseFineAxis& axis : machine.axes) axis.stroke = stroke;
    const RedundancyTask task = test::redundancy_task(test::holes(2, 2, 300, 3), machine);
    const double alone = plan_coarse_alone(task, {}, progress).head->duration();
    const RedundancyResult r = test::chosen(task, {});
    EXPECT_LE(r.head->duration(), alone * (1 + 1e-9));
    test::expect_valid(task, r);
  }
}

TEST(PlanChoice, OnRandomMachinesTheJointPlannerIsNeverSlowerThanTheCoarseAxesAlone) {
  Random random(14);
  Progress progress;
  for (int i = 0; i < 4; ++i) {
    SCOPED_TRACE(i);
    const Contour contour = test::random_contour(random, 800);
    const RedundancyTask task = test::redundancy_task(contour, test::random_machine(random));
    RedundancyOptions options;
    options.compare = false;
    const RedundancyResult r = test::chosen(task, options);
    test::expect_valid(task, r);
    EXPECT_LE(r.head->duration(), plan_coarse_alone(task, options, progress).head->duration() * (1 + 1e-9));
  }
}

/// ∫a² of a motion that takes s times as long is s⁻³ as much.
TEST(PlanChoice, TheCoarseAxesAloneAreStretchedForSmoothness) {
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) axis = coarse_alone(axis);
  const RedundancyTask task = test::redundancy_task(test::holes(2, 1, 30, 3), machine);
  RedundancyOptions options;
  const RedundancyResult quick = test::chosen(task, options);
  options.stretch = 1.1;
  const RedundancyResult slow = test::chosen(task, options);
  EXPECT_NEAR(slow.head->duration(), 1.1 * quick.head->duration(), 1e-12);
  ASSERT_EQ(quick.trades.size(), std::size(stretches));
  for (std::size_t i = 0; i < quick.trades.size(); ++i) {
    const double s = stretches[i];
    EXPECT_NEAR(quick.trades[i].duration, s * quick.head->duration(), 1e-12);
    EXPECT_NEAR(quick.trades[i].energy[0] * s * s * s, quick.trades[0].energy[0], 1e-6 * quick.trades[0].energy[0]);
  }
}

TEST(PlanChoice, APlanThatFailsVerificationGivesWayInTheOrderOfTheList) {
  RedundancyTask task = test::redundancy_task(test::framed(2, {}), test::md2());
  task.bound = 1e-3;  // s, that nothing attains: both directions are planned
  Progress progress;
  RedundancyOptions options;
  options.method = RedundancyMethod::filter;
  options.reparametrise = true;
  PlanChoice choice(task, options, progress);
  std::vector<double> durations;
  while (choice.next()) {
    durations.push_back(choice.plan().head->duration());
    ASSERT_LT(durations.size(), 10u);
    choice.reject(durations.back(), failed());
  }
  const std::vector<GaveWay> rows = choice.gave_way(durations.back());
  ASSERT_GE(rows.size(), 2u);
  EXPECT_EQ(rows[0].planner, timed_again);
  EXPECT_EQ(rows[0].duration, durations[0]);
  EXPECT_EQ(rows[0].used_duration, durations[1]);
  EXPECT_EQ(rows[1].planner, "filter");
  EXPECT_EQ(rows.back().used_duration, durations.back()) << "nothing takes the place of the last plan";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].reason, GivingWay::verification);
    EXPECT_EQ(rows[i].failed->value, 12);
    EXPECT_NE(rows[i].used, rows[i].planner) << "a plan in the other direction is the planner's own";
    if (i + 1 < rows.size()) {
      EXPECT_EQ(rows[i].used, rows[i + 1].planner);
    }
  }
}

/// What a slow filter leaves to the fine axes is nearly all of the motion, and they are slow.
TEST(PlanChoice, AMethodWithoutAMotionGivesWayToTheJointPlanner) {
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) axis.fine.velocity = 5;
  RedundancyOptions options;
  options.method = RedundancyMethod::filter;
  options.taps = 301;
  options.cutoff = 0.1;
  Progress progress;
  PlanChoice choice(test::redundancy_task(test::straight(600, 200), machine), options, progress);
  ASSERT_TRUE(choice.next());
  const double duration = choice.plan().head->duration();
  const std::vector<GaveWay> rows = choice.gave_way(duration);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].planner, "filter");
  EXPECT_EQ(rows[0].reason, GivingWay::no_motion);
  EXPECT_EQ(rows[0].used, "joint");
  EXPECT_EQ(rows[0].used_duration, duration);
  EXPECT_FALSE(choice.quicker_coarse_axes(duration)) << "the plan is not the method's";
}

/// A path beyond a range that no fine axis reaches.
TEST(PlanChoice, WhatHasNoPlanIsRefusedAtTheRange) {
  CoarseFineMachine machine = test::md2();
  machine.axes[0] = coarse_alone(machine.axes[0]);
  machine.axes[0].coarse.lowest = 0, machine.axes[0].coarse.highest = 100;
  for (CoarseFineAxis& axis : machine.axes) axis = coarse_alone(axis);
  Progress progress;
  PlanChoice choice(test::redundancy_task(test::straight(600, 200), machine), {}, progress);
  ASSERT_FALSE(choice.next());
  try {
    choice.refuse();
    FAIL();
  } catch (const InfeasibleAt& fault) {
    EXPECT_EQ(fault.faults.at(0).place, (std::vector<std::string>{"machine", "coarse", "x", "range"}));
  }
}

TEST(PlanChoice, TheJointPlanDoesNotDependOnTheFrame) {
  for (const bool jerk : {false, true})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(seed);
      const auto duration = [&](const test::Frame& frame) {
        const CoarseFineMachine machine = jerk ? test::with_jerk(test::md2(), 120) : test::md2();
        RedundancyOptions options;
        options.compare = false;
        return test::chosen(test::redundancy_task(test::framed(seed, frame), machine), options).head->duration();
      };
      const double here = duration({});
      for (const test::Frame& frame : test::other_frames) EXPECT_NEAR(duration(frame), here, 1e-6 * here);
    }
}

/// Where the bound leaves something open both directions are planned, and the quicker plan counts.
TEST(PlanChoice, AContourTakesAsLongBackwards) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RedundancyTask there = test::redundancy_task(test::framed(seed, {}), test::md2()),
                   back = test::redundancy_task(test::framed(seed, test::backwards), test::md2());
    there.bound = back.bound = 0.1;  // s, that nothing attains
    for (const RedundancyMethod method : {RedundancyMethod::joint, RedundancyMethod::iterative,
                                          RedundancyMethod::filter, RedundancyMethod::follow_up}) {
      SCOPED_TRACE(std::to_string(seed) + std::string(name_of<RedundancyMethod>(method, redundancy_methods)));
      RedundancyOptions options;
      options.method = method;
      options.compare = false;
      const double one = test::chosen(there, options).head->duration(),
                   other = test::chosen(back, options).head->duration();
      EXPECT_NEAR(one, other, 1e-6 * one);
    }
  }
}

}  // namespace
}  // namespace bahnwerk
