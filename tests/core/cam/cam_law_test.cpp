#include "core/cam/cam_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace bahnwerk::cam {
namespace {

/// 40 units in 2 s by the polynomial of degree 5 that begins and ends at rest.
CamLaw rest_to_rest(double begin = 0) { return {{begin, begin + 2}, {{0, {0, 0, 0, 40, 40, 40}}}, false}; }
/// Up by one and down again, 1 s each.
CamLaw up_and_down() { return {{3, 4, 5}, {{0, {0, 0, 1, 1}}, {1, {1, 1, 0, 0}}}, true}; }

TEST(CamLaw, DerivativesOfTheRestToRestPolynomial) {
  const CamLaw law = rest_to_rest();
  EXPECT_DOUBLE_EQ(law.evaluate(1, 0), 20);
  EXPECT_DOUBLE_EQ(law.evaluate(1, 1), 1.875 * 40 / 2);
  EXPECT_NEAR(law.evaluate(1, 2), 0, 1e-12);
  EXPECT_DOUBLE_EQ(law.evaluate(0, 3), 60 * 40 / 8.0);
  EXPECT_EQ(law.evaluate(1, 6), 0);
}

TEST(CamLaw, PeaksAreTheTrueOnes) {
  const CamLaw law = rest_to_rest(5);
  EXPECT_NEAR(law.peak(1).value, 37.5, 1e-12);
  EXPECT_NEAR(law.peak(1).at, 6, 1e-7);
  EXPECT_NEAR(law.peak(2).value, 10 / std::sqrt(3.0) * 10, 1e-12);
  EXPECT_NEAR(law.peak(3).value, 300, 1e-12);
  EXPECT_NEAR(law.extremes(2).lowest.value, -100 / std::sqrt(3.0), 1e-12);
}

TEST(CamLaw, APeriodicLawGoesOn) {
  const CamLaw law = up_and_down();
  EXPECT_DOUBLE_EQ(law.evaluate(3.5, 0), 0.5);
  EXPECT_DOUBLE_EQ(law.evaluate(1.5, 0), 0.5);
  EXPECT_DOUBLE_EQ(law.evaluate(0, 0), 1);
  EXPECT_DOUBLE_EQ(law.evaluate(7.25, 0), law.evaluate(3.25, 0) * 1);
}

TEST(CamLaw, ExtremesOfASectionAreItsOwn) {
  const LawExtremes down = up_and_down().section_extremes(1, 1);
  EXPECT_DOUBLE_EQ(down.lowest.value, -1.5);
  EXPECT_DOUBLE_EQ(down.highest.value, 0);
}

TEST(CamLaw, AsAMotionItBeginsWhereTheMasterDoes) {
  const auto motion = law_motion(up_and_down(), 0.25);
  EXPECT_EQ(motion->duration(), 2);
  EXPECT_EQ(motion->pieces(), 3u);
  for (const double t : {0.0, 0.3, 0.75, 1.2, 1.9}) {
    EXPECT_NEAR(motion->evaluate(t)[0][0], up_and_down().evaluate(t + 0.25, 0), 1e-14) << t;
    EXPECT_NEAR(motion->evaluate(t)[3][0], up_and_down().evaluate(t + 0.25, 3), 1e-12) << t;
  }
  Polynomial p;
  ASSERT_TRUE(motion->polynomial(1, 0, p));
  EXPECT_NEAR(evaluate(p, 0.5), motion->in_piece(1, motion->begin(1) + 0.5)[0][0], 1e-14);
}

TEST(CamLaw, ObjectiveIsTheWeightedSumOfPeaks) {
  MotionLawProblem problem;
  problem.length = 100, problem.cycle_duration = 2;
  problem.points.resize(2);
  problem.points[0].at = {0, 0}, problem.points[1].at = {100, 100};
  problem.points[0].values = {{0, 0}}, problem.points[1].values = {{40, 40}};
  problem.objective.weight = {0, 1, 0.5, 0.25};
  EXPECT_NEAR(evaluate_objective(problem, rest_to_rest()).objective, 37.5 + 50 / std::sqrt(3.0) + 75, 1e-11);
  problem.objective.normalised = true;
  EXPECT_NEAR(evaluate_objective(problem, rest_to_rest()).objective, 1.875 + 5 / std::sqrt(3.0) + 15, 1e-12);
  problem.objective.zero_crossing_penalty = 7;
  EXPECT_EQ(evaluate_objective(problem, rest_to_rest()).zero_crossings, 1u);  // of the acceleration
}

TEST(CamLaw, RefusesBreaksThatDoNotAscend) {
  EXPECT_THROW(CamLaw({0, 0}, {{0, {1}}}, false), std::invalid_argument);
  EXPECT_THROW(CamLaw({0, 1, 2}, {{0, {1}}}, false), std::invalid_argument);
}

TEST(CamLaw, RmsValuesOfTheRestToRestPolynomialAreThoseOfItsFormula) {
  const CamLaw law({0, 2, 3}, {{0, {0, 0, 0, 12, 12, 12}}, {1, {12, 12}}}, false);
  EXPECT_NEAR(law.section_rms(2, 0), 12 / 4.0 * std::sqrt(120.0 / 7), 1e-12);
  EXPECT_NEAR(law.section_rms(3, 0), 12 / 8.0 * std::sqrt(720.0), 1e-12);
  EXPECT_NEAR(law.rms(3), law.section_rms(3, 0) * std::sqrt(2.0 / 3), 1e-12);
  EXPECT_EQ(law.section_rms(2, 1), 0);
}

TEST(CamLaw, APeriodicLawMovesOnByItsTravelInEachCycle) {
  const CamLaw law({1, 3}, {{0, {5, 5, 5, 12, 12, 12}}}, true, 7);
  for (const double t : {1.0, 1.3, 2.9}) {
    EXPECT_NEAR(law.evaluate(t + 2, 0), law.evaluate(t, 0) + 7, 1e-12);
    EXPECT_NEAR(law.evaluate(t - 4, 0), law.evaluate(t, 0) - 14, 1e-12);
    EXPECT_NEAR(law.evaluate(t + 2, 1), law.evaluate(t, 1), 1e-9);
  }
  for (const double first : {0.2, 2.4, -3.1}) {
    const CamLaw cut = law_from(law, first);
    for (const double t : {0.0, 0.4, 1.1, 1.9}) EXPECT_NEAR(cut.evaluate(t, 0), law.evaluate(first + t, 0), 1e-12);
  }
}

}  // namespace
}  // namespace bahnwerk::cam
