/// Sections of a classical law inside an optimal one: what their neighbours and J see of them.
#include "core/cam/optimal/task/given_sections.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/optimal/optimal_law.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

using testing::fixed;
using testing::point_at;
constexpr double pi = std::numbers::pi;

/// A cycloidal rise of 30 mm, a dwell, and a return without a law, 1 ms per degree.
MotionLawProblem rise_dwell_return(double rise, double dwell, double back) {
  MotionLawProblem problem;
  problem.method = LawMethod::optimal;
  problem.periodic = true;
  problem.length = rise + dwell + back;
  problem.cycle_duration = problem.length / 1000;
  problem.objective.weight = {0, 1, 0.03, 0.001};
  problem.points = {point_at(0, {fixed(0)}), point_at(rise, {fixed(30)}), point_at(rise + dwell, {fixed(30)})};
  problem.points[0].law = ClassicalLaw::inclined_sine;
  problem.points[1].law = ClassicalLaw::straight;
  problem.degree = 7;
  problem.pieces = 2;
  return problem;
}

TEST(GivenSections, EndsAreConditionsOfTheirNeighboursAndPeaksAreFloors) {
  MotionLawProblem problem = rise_dwell_return(100, 50, 90);
  problem.points[1].law.reset();
  problem.points[0].section[1] = {0, 700};
  const LawTask task = make_law_task(problem);
  ASSERT_TRUE(task.is_given(0));
  EXPECT_FALSE(task.is_given(1));
  const double length = task.at[1].min - task.at[0].min;
  EXPECT_NEAR(task.given[0]->peak_at(1, length), 2 * 30 / 0.1 * task.to_task(1), 1e-9);
  EXPECT_NEAR(task.given[0]->peak_at(2, length), 2 * pi * 30 / 0.01 * task.to_task(2), 1e-8);
  EXPECT_NEAR(task.given[0]->peak_at(3, length), 4 * pi * pi * 30 / 0.001 * task.to_task(3), 1e-6);
  EXPECT_TRUE(task.limits[0][1].free());
  EXPECT_EQ(task.given[0]->law.breaks.back(), 1);
  int known = 0;
  for (const LawTask::Condition& condition : task.conditions) {
    if (condition.given == LawTask::none) continue;
    EXPECT_EQ(condition.given, 0u);
    EXPECT_NEAR(condition.range.min, condition.order == 0 && condition.point == 1 ? 1 : 0, 1e-9);
    ++known;
  }
  EXPECT_EQ(known, 6);  // position, velocity, acceleration at both ends
}

/// A return that is faster than the rise is what it would be alone between its rests.
TEST(GivenSections, AFastReturnIsThatOfTheReturnAlone) {
  Progress progress;
  const OptimalLaw mixed = plan_optimal_law(rise_dwell_return(200, 30, 80), progress);
  MotionLawProblem alone;
  alone.method = LawMethod::optimal;
  alone.length = 80;
  alone.cycle_duration = 0.08;
  alone.objective.weight = {0, 1, 0.03, 0.001};
  alone.points = {point_at(0, {fixed(30), fixed(0), fixed(0)}), point_at(80, {fixed(0), fixed(0), fixed(0)})};
  alone.degree = 7;
  alone.pieces = 2;
  const OptimalLaw single = plan_optimal_law(alone, progress);
  EXPECT_TRUE(mixed.proven);
  const double objective = single.solution.value.objective;
  EXPECT_NEAR(mixed.solution.value.objective, objective, 3e-8 * objective);
  EXPECT_NEAR(mixed.solution.bound->objective, single.solution.bound->objective, 2e-3 * objective);
  EXPECT_LE(mixed.solution.bound->objective, mixed.solution.value.objective);
  EXPECT_NE(mixed.solution.bound->basis.find("classical sections"), std::string::npos);
}

/// A slow return never shows: J is what the rise alone is worth, and so are both bounds.
TEST(GivenSections, BehindAFastRiseJIsThatOfTheRise) {
  Progress progress;
  const OptimalLaw mixed = plan_optimal_law(rise_dwell_return(60, 40, 300), progress);
  const double t = 0.06, rise = 2 * 30 / t + 0.03 * 2 * pi * 30 / (t * t) + 0.001 * 4 * pi * pi * 30 / (t * t * t);
  EXPECT_TRUE(mixed.proven);
  EXPECT_NEAR(mixed.solution.value.objective, rise, 1e-9 * rise);
  EXPECT_NEAR(mixed.solution.bound->objective, rise, 1e-5 * rise);
  EXPECT_LE(mixed.solution.bound->objective, mixed.solution.value.objective);
}

/// The section is the textbook's: s = h (z − sin 2πz/2π), whatever is optimised beside it.
TEST(GivenSections, TheLawHasThePiecesOfTheTextbook) {
  Progress progress;
  MotionLawProblem problem = rise_dwell_return(110, 50, 70);
  problem.degree.reset();
  const OptimalLaw mixed = plan_optimal_law(problem, progress);
  for (double z = 0; z < 1; z += 0.037)
    EXPECT_NEAR(mixed.solution.law.evaluate(0.11 * z, 0), 30 * (z - std::sin(2 * pi * z) / (2 * pi)), 1e-11);
  EXPECT_GT(mixed.solution.degrees[0], mixed.degree);
  EXPECT_EQ(mixed.solution.degrees[2], mixed.degree);
  EXPECT_LE(mixed.solution.value.objective, 1.011 * mixed.solution.bound->objective);
}

/// A drive's acceleration limit A is reached in the modified sine of h in T: A = 4π²/(4 + π) h/T².
TEST(GivenSections, TheShortestCycleIsThatOfTheClassicalSectionThatLimitsIt) {
  Progress progress;
  MotionLawProblem problem = rise_dwell_return(60, 40, 300);
  problem.points[0].law = ClassicalLaw::modified_sine;
  problem.cycle_duration.reset();
  problem.drive = DriveLimits{};
  problem.drive->acceleration = 9000;
  const OptimalLaw found = plan_optimal_law(problem, progress);
  const double rise = std::sqrt(4 * pi * pi / (4 + pi) * 30 / 9000);
  EXPECT_NEAR(found.solution.cycle_duration, rise * 400 / 60, 1e-6 * rise * 400 / 60);
}

/// Parabolas have no jerk inside their pieces: J is that of their velocity and acceleration, and both bounds say so.
TEST(GivenSections, PeaksThatVanishLeaveTheBounds) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(30, 0.5);
  problem.points[0].values = problem.points[1].values = {fixed(0)};
  problem.points[1].values[0] = fixed(30);
  problem.points[0].law = ClassicalLaw::quadratic;
  const OptimalLaw found = plan_optimal_law(problem, progress);
  const double expected = 2 * 30 / 0.5 + problem.objective.weight[2] * 4 * 30 / 0.25;
  EXPECT_NEAR(found.solution.value.objective, expected, 1e-9 * expected);
  EXPECT_NEAR(*found.solution.lower, expected, 1e-7 * expected);
  EXPECT_NEAR(found.solution.bound->objective, expected, 1e-6 * expected);
}

/// Two 3-4-5 polynomials, 30 mm up and 10 mm back in 0.4 s: the velocity is least where both have the same, 1.875 · 40
/// mm / 0.4 s, at three quarters of the cycle.
TEST(GivenSections, TheirAnglesAreChosen) {
  Progress progress;
  MotionLawProblem problem;
  problem.method = LawMethod::optimal;
  problem.length = 360;
  problem.cycle_duration = 0.4;
  problem.objective.weight = {0, 1, 0, 0};
  problem.points = {point_at(0, {fixed(0), fixed(0), fixed(0)}), point_at(0, {fixed(30)}),
                    point_at(360, {fixed(20), fixed(0), fixed(0)})};
  problem.points[1].at = {60, 300};
  problem.points[0].law = problem.points[1].law = ClassicalLaw::polynomial_345;
  problem.degree = 5;
  const OptimalLaw found = plan_optimal_law(problem, progress);
  EXPECT_NEAR(found.solution.value.objective, 1.875 * 40 / 0.4, 1e-5 * 187.5);
  EXPECT_NEAR(found.solution.at[1], 270, 1e-2);
  EXPECT_LE(found.solution.bound->objective, found.solution.value.objective);
  EXPECT_GE(found.solution.bound->objective, 0.99 * 187.5);
}

TEST(GivenSections, StretchWhereTheyRestAsFarAsContinuityAsks) {
  MotionLawProblem problem = rise_dwell_return(100, 50, 90);
  EXPECT_TRUE(section_stretches(problem, 0));
  EXPECT_FALSE(section_stretches(problem, 2));
  problem.points[1].continuity = 3;  // the cycloid's jerk is not 0 there
  EXPECT_FALSE(section_stretches(problem, 0));
  problem.points[0].law = ClassicalLaw::polynomial_4567;
  EXPECT_TRUE(section_stretches(problem, 0));
  problem.points[0].section[1] = {0, 900};
  EXPECT_FALSE(section_stretches(problem, 0));
  problem.points[0].section[1] = {};
  problem.points[1].values.push_back(fixed(20));
  EXPECT_FALSE(section_stretches(problem, 0));
}

/// Motion to motion: the spline takes over the velocity of the polynomial before it.
TEST(GivenSections, JoinInMotion) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(40, 0.3);
  problem.points.insert(problem.points.begin() + 1, point_at(35, {fixed(14), fixed(170), fixed(250)}, 3));
  problem.points[0].law = ClassicalLaw::polynomial_4567;
  problem.degree = 9;
  const OptimalLaw found = plan_optimal_law(problem, progress);
  const CamLaw& law = found.solution.law;
  const double at = law.breaks()[1];
  const double scale[] = {1, 1e2, 1e4, 1e6};
  for (int r = 0; r < 4; ++r) EXPECT_NEAR(law.in_piece(0, 1, r), law.in_piece(1, 0, r), 1e-9 * scale[r]) << r;
  EXPECT_NEAR(law.evaluate(at, 1), 170, 1e-7);
  EXPECT_NEAR(law.evaluate(at, 2), 250, 1e-4);
}

std::vector<std::vector<std::string>> refused(const MotionLawProblem& problem) {
  Progress progress;
  std::vector<std::vector<std::string>> places;
  try {
    plan_optimal_law(problem, progress);
  } catch (const InvalidInput& fault) {
    for (const InputFault& each : fault.faults) places.push_back(each.place);
  }
  return places;
}
using Places = std::vector<std::vector<std::string>>;

TEST(GivenSections, WhatTheyCannotKeepIsNamed) {
  MotionLawProblem limit = rise_dwell_return(100, 50, 90);
  limit.points[0].section[1] = {0, 599};
  EXPECT_EQ(refused(limit), (Places{{"points", "0", "section", "velocity"}}));
  MotionLawProblem degree = rise_dwell_return(100, 50, 90);
  degree.degree = 4;  // six conditions on one piece
  degree.pieces = 1;
  const Places places = refused(degree);
  ASSERT_FALSE(places.empty());
  EXPECT_EQ(places[0], (std::vector<std::string>{"points", "0", "law"}));
  MotionLawProblem jump = rise_dwell_return(100, 50, 90);
  jump.points[0].law = ClassicalLaw::simple_harmonic;  // its acceleration ends at π²h/2T²: a dwell has none
  EXPECT_EQ(refused(jump), (Places{{"points", "1", "continuity"}}));
}

}  // namespace
}  // namespace bahnwerk::cam
