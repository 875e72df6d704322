#include "core/cam/table/controller_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk::cam {
namespace {

const TableCycle cycle{0, 100, 2};
/// 40 units in 2 s from rest to rest, by polynomials of degree 5 and 9.
CamLaw quintic() { return {{0, 2}, {{0, {0, 0, 0, 40, 40, 40}}}, false}; }
CamLaw ninth() { return {{0, 2}, {{0, {0, 0, 0, 0, 0, 40, 40, 40, 40, 40}}}, false}; }

TEST(ControllerTable, ALawOfDegreeFiveIsItself) {
  const ControllerTable table = breaks_table(quintic(), cycle, 100);
  ASSERT_EQ(table.points.size(), 2u);
  EXPECT_EQ(table.points[0].next, Between::quintic);
  EXPECT_LT(table.error[0], 1e-13);
  EXPECT_LT(table.error[3], 1e-10);
}

TEST(ControllerTable, DerivativesAreByTheMaster) {
  const ControllerTable table = even_table(quintic(), cycle, 2, Between::quintic);
  ASSERT_EQ(table.points.size(), 3u);
  EXPECT_DOUBLE_EQ(table.points[1].master, 50);
  EXPECT_DOUBLE_EQ(table.points[1].velocity, 1.875 * 40 / 100);
  EXPECT_NEAR(table.points[0].jerk, 60 * 40 / 1e6, 1e-15);
}

TEST(ControllerTable, AHigherDegreeIsRefittedAndTheErrorIsTheTrueOne) {
  const ControllerTable table = even_table(ninth(), cycle, 4, Between::quintic);
  // Sampled: the quintic of the first interval against the law.
  const auto& p = table.points;
  double most = 0;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const double w = p[i + 1].master - p[i].master;
    for (int k = 1; k < 200; ++k) {
      const double x = k / 200.0, y = 1 - x;
      const double x3 = x * x * x, y3 = y * y * y;
      const double s = p[i].position * y3 * (1 + 3 * x + 6 * x * x) + p[i + 1].position * x3 * (1 + 3 * y + 6 * y * y) +
                       w * (p[i].velocity * x * y3 * (1 + 3 * x) - p[i + 1].velocity * y * x3 * (1 + 3 * y)) +
                       w * w / 2 * (p[i].acceleration * x * x * y3 + p[i + 1].acceleration * y * y * x3);
      most = std::max(most, std::abs(s - ninth().evaluate((p[i].master + x * w) / 50, 0)));
    }
  }
  EXPECT_NEAR(table.error[0], most, 1e-3 * most);
  EXPECT_GT(table.error[3], 0);
}

TEST(ControllerTable, PiecesAreDividedUntilTheTableFits) {
  const ControllerTable table = breaks_table(ninth(), cycle, 100);
  EXPECT_GT(table.points.size(), 2u);
  EXPECT_LE(table.error[0], 4e-5);
  EXPECT_LE(table.error[3], 0.01 * ninth().peak(3).value);
  EXPECT_EQ(breaks_table(ninth(), cycle, 3).points.size(), 3u);
}

/// 40 units in 2 s by constant acceleration and deceleration.
CamLaw parabolas() { return {{0, 1, 2}, {{0, {0, 0, 20}}, {0, {20, 40, 40}}}, false}; }

TEST(ControllerTable, AJumpOfTheAccelerationIsCarriedExactlyWhereCurvesHaveStatesOfTheirOwn) {
  const ControllerTable table = breaks_table(parabolas(), cycle, 51, false, true);
  ASSERT_EQ(table.points.size(), 3u);
  EXPECT_EQ(table.steps, 0u);
  EXPECT_LT(table.error[0], 1e-13);
  EXPECT_LT(table.error[2], 1e-11);
  EXPECT_NEAR(table.ends[0].acceleration, 40.0 / 2500, 1e-15);
  EXPECT_NEAR(table.points[1].acceleration, -40.0 / 2500, 1e-15);
}

TEST(ControllerTable, AJumpOfTheAccelerationTakesAShortCurveWhereAPointHasOneState) {
  const ControllerTable table = breaks_table(parabolas(), cycle, 51, false);
  ASSERT_EQ(table.points.size(), 4u);
  EXPECT_EQ(table.steps, 1u);
  EXPECT_NEAR(table.longest_step, 0.05, 1e-12);
  EXPECT_NEAR(table.points[1].acceleration, 40.0 / 2500, 1e-15);
  EXPECT_NEAR(table.points[2].acceleration, -40.0 / 2500, 1e-15);
  EXPECT_LT(table.error[0], 4e-5);
}

TEST(ControllerTable, ALawOfMorePiecesThanPointsKeepsItsJumpsAndTheWorstCurvesAreDivided) {
  std::vector<double> breaks{0};
  std::vector<LawPiece> pieces;
  for (int i = 0; i < 80; ++i) {  // 39 pieces of one parabola, 41 of the other
    breaks.push_back(i < 39 ? (i + 1) / 39.0 : 1 + (i - 38) / 41.0);
    const double from = breaks[breaks.size() - 2], to = breaks.back(), middle = (from + to) / 2;
    const auto s = [](double t) { return t <= 1 ? 20 * t * t : 40 - 20 * (2 - t) * (2 - t); };
    pieces.push_back({0, {s(from), 2 * s(middle) - (s(from) + s(to)) / 2, s(to)}});
  }
  const ControllerTable table = breaks_table({breaks, pieces, false}, cycle, 51, false, true);
  EXPECT_EQ(table.points.size(), 3u);
  EXPECT_LT(table.error[0], 1e-12);
  EXPECT_LT(table.error[2], 1e-9);
}

TEST(ControllerTable, WhatIsRoundingBesideTheColumnIsZero) {
  const CamLaw law({0, 2}, {{0, {0, 0, 1e-17, 40, 40 - 1e-15, 40}}}, false);
  const ControllerTable table = breaks_table(law, cycle, 51, false);
  EXPECT_EQ(table.points[0].acceleration, 0);
  EXPECT_EQ(table.points[1].velocity, 0);
  EXPECT_FALSE(std::signbit(table.points[1].acceleration));
}

TEST(ControllerTable, StraightLinesMissTheWholeAcceleration) {
  const ControllerTable table = even_table(quintic(), cycle, 1000, Between::straight);
  EXPECT_EQ(table.points.size(), 1001u);
  EXPECT_NEAR(table.error[2], quintic().peak(2).value, 1e-9);
  EXPECT_NEAR(table.error[0], quintic().peak(2).value * 0.002 * 0.002 / 8, 1e-7);
}

}  // namespace
}  // namespace bahnwerk::cam
