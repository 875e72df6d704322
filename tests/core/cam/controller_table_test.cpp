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

TEST(ControllerTable, StraightLinesMissTheWholeAcceleration) {
  const ControllerTable table = even_table(quintic(), cycle, 1000, Between::straight);
  EXPECT_EQ(table.points.size(), 1001u);
  EXPECT_NEAR(table.error[2], quintic().peak(2).value, 1e-9);
  EXPECT_NEAR(table.error[0], quintic().peak(2).value * 0.002 * 0.002 / 8, 1e-7);
}

}  // namespace
}  // namespace bahnwerk::cam
