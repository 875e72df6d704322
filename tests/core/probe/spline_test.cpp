#include "core/probe/spline/spline.hpp"

#include "core/base/progress.hpp"
#include "core/probe/straight/stops.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

ProbeMotion spline(const ProbeProblem& problem) {
  Progress silent;
  return plan_spline(problem, silent);
}

TEST(Spline, StraightsAreTheProfileOfFifteenPhases) {
  const ProbeProblem p = problem({{-40, 0, 0}, {-20, 0, 0}, {-20, 0, 0}, {10, 0, 0}, {40, 0, 0}}, 0, 3);
  EXPECT_NEAR(spline(p).duration(), 4.17, 1e-12);
  expect_right(p, spline(p));
}

TEST(Spline, WithoutToleranceTheHeadRestsAtCorners) {
  const ProbeProblem p = problem({{0, 0}, {5, 0}, {5, 5}}, 0);
  EXPECT_NEAR(spline(p).duration(), 0.84, 1e-12);
  expect_right(p, spline(p));
}

TEST(Spline, IsNeverSlowerThanRestsAndKeepsEverything) {
  const std::vector<std::pair<std::string, ProbeProblem>> cases{
      {"corner", problem({{0, 0}, {5, 0}, {5, 5}}, 0.05)},
      {"wide corner", problem({{0, 0}, {5, 0}, {5, 5}}, 2)},
      {"reversal", problem({{0, 0}, {50, 0}, {0, 0}}, 0.05)},
      {"circle", problem(circle(60, 10), 0.05)},
      {"fine circle", problem(circle(600, 10), 0.05)},
      {"space", problem({{0, 0, 0}, {12, 3, 1}, {20, 14, 9}, {9, 20, 22}, {-3, 10, 30}}, 0.4, 3)}};
  for (const auto& [name, p] : cases) {
    const ProbeMotion plan = spline(p);
    EXPECT_LE(plan.duration(), stops_duration(p) * (1 + 1e-12)) << name;
    expect_right(p, plan, name);
  }
}

TEST(Spline, DensePointsArePassedAtNominalSpeed) {
  for (const std::size_t n : {80u, 900u}) {
    const ProbeProblem p = problem(circle(n, 9), 0.05);
    const double at_speed = 2 * M_PI * 9 / 20;
    EXPECT_LT(spline(p).duration(), 1.25 * (at_speed + 0.17)) << n;
  }
}

TEST(Spline, EnclosuresOfManyEqualPeaksOfSpeedDoNotAddUp) {
  std::vector<Vec> points = circle(271, 116.5);
  points.pop_back();
  ProbeProblem p = problem(std::move(points), 0.0107, 3, 2.4046);
  const double limits[3][3] = {
      {0.27064, 0.28931, 0.038692}, {0.12801, 0.0034117, 0.00010066}, {0.056415, 0.0016296, 2.4079e-05}};
  for (std::size_t k = 0; k < 3; ++k) {
    AxisLimits& axis = p.machine.axes[k];
    axis.acceleration = limits[k][0], axis.jerk = limits[k][1], axis.snap = limits[k][2];
  }
  expect_right(p, spline(p));
}

TEST(Spline, ThousandsOfPointsWithManyRestsAreRightToTheEnd) {
  // Splines and rests alternate for minutes; served motions are slowed to whole cycles.
  Random random(7);
  std::vector<Vec> points{{0, 0}};
  for (int i = 0; i < 2500; ++i) {
    const double step = i % 50 < 25 ? 1 : 0.02;  // a walk, and a straight with noise
    points.push_back(points.back() + Vec{step * random.uniform(-1, 1) + (1 - step), step * random.uniform(-1, 1)});
  }
  const ProbeProblem p = problem(points, 0.05);
  const ProbeMotion plan = spline(p);
  EXPECT_LT(plan.duration(), 0.95 * stops_duration(p));
  const double whole = 0.05 * std::ceil(plan.duration() / 0.05);
  expect_right(p, slowed(plan, whole / plan.duration(), whole));
}

/// A zigzag rests at every point; a run finds the ones next to its ends first.
TEST(Spline, WhatAZigzagTakesGrowsLinearlyWithItsPoints) {
  struct Counting : ProgressSink {
    std::size_t reports = 0;
    void report(std::string_view, double, std::string_view) override { ++reports; }
  };
  const auto reports = [](std::size_t n) {
    std::vector<Vec> points;
    for (std::size_t i = 0; i < n; ++i)
      points.push_back({5.0 * static_cast<double>(i), 10.0 * static_cast<double>(i % 2)});
    const ProbeProblem p = problem(points, 0.3, 2, 10, 250, 5000, 250000);
    Counting counting;
    const ProbeMotion plan = plan_spline(p, counting);
    EXPECT_LE(plan.duration(), stops_duration(p) * (1 + 1e-9)) << n;
    return counting.reports;
  };
  const std::size_t few = reports(2100), many = reports(8400);
  EXPECT_GT(few, 10u);
  EXPECT_LE(many, 5 * few) << few;
}

TEST(Spline, PhasesTooShortForTheirRoundingAreNoReasonToBeSlowerThanRests) {
  // The jerk is reached within 4e-12 s.
  const ProbeProblem p = problem({{0, 0}, {5, 0}, {5, 5}}, 0.05, 2, 20, 200, 4000, 1e15);
  Progress silent;
  const ProbeMotion plan = plan_spline(p, silent);
  expect_right(p, plan);
  EXPECT_LT(plan.duration(), 0.84);  // what rests take where the snap is 200 000 mm/s⁴
}

}  // namespace
}  // namespace bahnwerk
