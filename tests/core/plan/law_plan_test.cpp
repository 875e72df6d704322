#include "core/plan/motion_law/law_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/plan/motion_law/law_drawings.hpp"
#include "core/plan/motion_law/law_spectrum.hpp"
#include "tests/core/cam/problems.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk {
namespace {

using namespace cam::testing_problems;

LawPlan planned(const cam::MotionLawProblem& problem, LawSampling sampling = {}) {
  Progress progress;
  return plan_motion_law(problem, sampling, progress);
}

cam::MotionLawProblem random_problem(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const bool periodic = random() % 2 == 0;
  const std::size_t n = 3 + random() % 3;
  std::vector<cam::MotionPoint> points;
  double at = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double position = 40 * unit(random);
    cam::MotionPoint p = point(at, 2 + static_cast<int>(random() % 2), {number(position)});
    if (i > 0 && random() % 2) p.values[0] = {position - 3, position + 3};
    if (random() % 2) p.values.push_back({-0.3, 0.3});
    points.push_back(std::move(p));
    at += 20 + 40 * unit(random);
  }
  if (!periodic) at = points.back().at.min, points.front() = rest(0, 5), points.back() = rest(at, 30);
  cam::MotionLawProblem out = problem(at, periodic, points);
  out.cycle_duration = 0.4;
  out.objective.weight = {0, 1, 0.05, 0.002};
  return out;
}

TEST(LawPlan, RandomProblemsAreVerifiedAndTheOptimumIsNoWorseThanTheActiveSet) {
  std::mt19937 random(9);
  int compared = 0;
  for (int i = 0; i < testing::cases(12); ++i) {
    cam::MotionLawProblem problem = random_problem(random);
    LawPlan active;
    try {
      active = planned(problem);
    } catch (const PlanningError&) {
      continue;  // singular, or no order of conversions ends
    }
    EXPECT_TRUE(active.verification.passed) << i;
    problem.method = cam::LawMethod::optimal;
    problem.degree = std::max(5, static_cast<int>(active.solution.law.max_degree()));
    const LawPlan optimal = planned(problem);
    EXPECT_TRUE(optimal.verification.passed) << i;
    const double best = optimal.solution.value.objective;
    EXPECT_LE(best, active.solution.value.objective * (1 + 1e-7)) << i;
    EXPECT_LE(optimal.lower, best) << i;
    EXPECT_LE(active.lower, best * (1 + 1e-9)) << i;
    ++compared;
  }
  EXPECT_GT(compared, testing::cases(12) / 2);
}

/// A law of the textbook is one of all laws: their bound says what it costs. One whose acceleration jumps is none.
TEST(LawPlan, ClassicalLawsAreComparedWithTheBoundOverAllLaws) {
  cam::MotionLawProblem p =
      problem(1, false, {point(0, 2, {number(0), number(0)}), point(1, 2, {number(20), number(0)})});
  p.objective.weight = {0, 1, 0.1, 0.01};
  p.points[0].law = cam::ClassicalLaw::modified_sine;
  const LawPlan smooth = planned(p);
  EXPECT_LE(smooth.lower, smooth.solution.value.objective);
  EXPECT_GT(smooth.lower, 0.5 * smooth.solution.value.objective);
  p.points[0].law = cam::ClassicalLaw::quadratic;
  const LawPlan jumping = planned(p);
  EXPECT_NEAR(jumping.lower, 20 / jumping.solution.cycle_duration, 1e-9);  // the mean velocity
  EXPECT_TRUE(jumping.verification.passed);
}

/// A law of degree 11 that stands still at both points: its residual vibration is as small as the verifier asks.
TEST(LawPlan, ResidualVibrationOfAHighDegreeIsVerified) {
  cam::MotionLawProblem p = problem(45, true, {rest(0, 47), rest(15, 38)});
  p.cycle_duration = 0.125;
  p.method = cam::LawMethod::optimal;
  p.objective.weight = {0, 1, 0.02, 0.0005};
  p.degree = 11;
  p.pieces = 2;
  p.vibration = {{9, 0}};
  for (cam::MotionPoint& each : p.points) each.still = true;
  p.points[1].values.resize(5);
  p.points[1].values[4] = number(0);
  const LawPlan plan = planned(p);
  EXPECT_TRUE(plan.verification.passed);
}

TEST(LawPlan, ACycleTimeThatDoesNotDivideTheCycleHasNoSteps) {
  EXPECT_EQ(table_steps({0.001, {}}, 0.5), 500u);
  EXPECT_EQ(table_steps({0.003, {}}, 0.5), 0u);
  EXPECT_EQ(table_steps({{}, 123}, 0.5), 123u);
  EXPECT_EQ(table_steps({}, 0.5), 720u);
}

TEST(LawPlan, TheSpectrumHasTheEnergyOfTheAcceleration) {
  // Parseval: Σ amplitude²/2 is the mean square of an acceleration without mean.
  const LawPlan plan = planned(problem(2, true, {rest(0, 0), rest(1, 20)}));
  double mean_square = 0, sum = 0;
  for (int k = 0; k < 2000; ++k) mean_square += std::pow(plan.solution.law.evaluate(k / 1000.0, 2), 2) / 2000;
  for (const double amplitude : acceleration_spectrum(plan.solution.law, 200)) sum += amplitude * amplitude / 2;
  EXPECT_NEAR(sum, mean_square, 1e-5 * mean_square);
}

TEST(LawPlan, DrawingsShowTheLawItsBoxesAndItsLimits) {
  cam::MotionLawProblem p = problem(130, false, {rest(0, 0), point(55, 3, {{24, 26}}), rest(130, 45)});
  p.points[1].section[1] = {-0.1, 1};
  const LawPlan plan = planned(p);
  const std::string drawing = law_drawing(plan);
  EXPECT_NE(drawing.find("J 3.29793"), std::string::npos);
  EXPECT_NE(drawing.find("fill-opacity"), std::string::npos);
  EXPECT_NE(drawing.find("#c1121f"), std::string::npos);
  EXPECT_EQ(drawing.find("nan"), std::string::npos);
  EXPECT_LT(drawing.size(), 200000u);
  EXPECT_EQ(spectrum_drawing(plan).find("nan"), std::string::npos);
}

TEST(LawPlan, LegendNamesOnlyWhatIsDrawn) {
  cam::MotionLawProblem p = problem(130, false, {rest(0, 0), point(55, 3, {{25, 25}}), rest(130, 45)});
  const std::string plain = law_drawing(planned(p));
  const std::size_t named = plain.find(">numbers<");
  ASSERT_NE(named, std::string::npos);
  EXPECT_LT(plain.find("<circle"), named);  // its dot is in the legend, before the panels' dots
  EXPECT_EQ(plain.find("ranges"), std::string::npos);
  EXPECT_EQ(plain.find("limits of sections"), std::string::npos);
  p.points[1].values[0] = {24, 26};
  EXPECT_NE(law_drawing(planned(p)).find(">ranges<"), std::string::npos);
  p.points[1].section[1] = {-0.1, 1};
  EXPECT_NE(law_drawing(planned(p)).find(">limits of sections<"), std::string::npos);
}

/// Centres and lengths of the labels along the master of a drawing.
std::vector<std::pair<double, std::size_t>> centred_labels(const std::string& drawing) {
  std::vector<std::pair<double, std::size_t>> labels;
  for (std::size_t at = drawing.find("<text x="); at != std::string::npos; at = drawing.find("<text x=", at + 1)) {
    const std::size_t open = drawing.find('>', at), close = drawing.find('<', open);
    if (drawing.substr(at, open - at).find("\"middle\"") == std::string::npos) continue;
    labels.emplace_back(std::stod(drawing.substr(at + 9)), close - open - 1);
  }
  return labels;
}

TEST(LawPlan, FrequenciesUnderTheSpectrumDoNotOverlap) {
  for (const double duration : {0.6, 1.0, 0.0007, 7.0}) {
    cam::MotionLawProblem p = problem(2, true, {rest(0, 0), rest(1, 20)});
    p.cycle_duration = duration;
    const auto labels = centred_labels(spectrum_drawing(planned(p)));
    ASSERT_GE(labels.size(), 5u);
    for (std::size_t i = 1; i < labels.size(); ++i) {
      const double letters = 0.5 * static_cast<double>(labels[i - 1].second + labels[i].second);
      EXPECT_GE(labels[i].first - labels[i - 1].first, 6.5 * letters + 4) << duration << " s";
    }
  }
}

}  // namespace
}  // namespace bahnwerk
