#include "core/redundant/iterative/spline_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/core/redundant/iterative/random_knots.hpp"

namespace bahnwerk {
namespace {

double of(const SplineRow& row, const std::vector<double>& d) {
  double sum = 0;
  for (std::size_t r = 0; r < row.count; ++r) sum += row.weights[r] * d[row.first + r];
  return sum;
}

TEST(SplineSpace, RowsAreThePolynomialsThatItBecomes) {
  Random random(1);
  for (std::size_t degree = 2; degree <= 5; ++degree)
    for (std::size_t multiplicity = 1; multiplicity < degree; ++multiplicity) {
      const SplineSpace space(degree, test::random_knots(random, degree, 6, multiplicity, 2));
      std::vector<double> d(space.size());
      for (double& v : d) v = random.uniform(-1, 1);
      const TimeSpline s = space.spline(d);
      EXPECT_EQ(s.pieces(), 7u);
      std::size_t span = 0;
      for (int i = 0; i < 50; ++i) {
        const double t = 2 * (i + 0.5) / 50;
        const AxisState x = s.in_piece(s.find(t, 0), t);
        EXPECT_NEAR(x.x, of(space.at(t, 0, span), d), 1e-12);
        EXPECT_NEAR(x.v, of(space.at(t, 1, span), d), 1e-10);
        EXPECT_NEAR(x.a, of(space.at(t, 2, span), d), 1e-8);
        if (degree > 2) {
          EXPECT_NEAR(x.j, of(space.at(t, 3, span), d), 1e-6);
        }
      }
      for (std::size_t i = 1; i < s.pieces(); ++i) {  // C^(degree − multiplicity)
        const AxisState a = s.in_piece(i - 1, s.begin(i)), b = s.in_piece(i, s.begin(i));
        EXPECT_NEAR(a.x, b.x, 1e-12);
        if (degree > multiplicity) {
          EXPECT_NEAR(a.v, b.v, 1e-9);
        }
        if (degree > multiplicity + 1) {
          EXPECT_NEAR(a.a, b.a, 1e-7);
        }
      }
    }
}

TEST(SplineSpace, ControlPointsOfDerivativesBoundThem) {
  Random random(2);
  for (std::size_t degree = 2; degree <= 5; ++degree) {
    const SplineSpace space(degree, test::random_knots(random, degree, 9, 1, 3));
    std::vector<double> d(space.size());
    for (double& v : d) v = random.uniform(-1, 1);
    const TimeSpline s = space.spline(d);
    for (std::size_t order = 1; order <= 2; ++order) {
      double low = 1e300, high = -1e300;
      SplineRow row;
      for (std::size_t i = 0; i + order < space.size(); ++i) {
        ASSERT_TRUE(space.control(order, i, row));
        low = std::min(low, of(row, d)), high = std::max(high, of(row, d));
      }
      double seen_low = 1e300, seen_high = -1e300;
      for (int i = 0; i <= 1000; ++i) {
        const AxisState x = s.in_piece(s.find(3e-3 * i, 0), 3e-3 * i);
        const double v = order == 1 ? x.v : x.a;
        EXPECT_GE(v, low - 1e-7);
        EXPECT_LE(v, high + 1e-7);
        seen_low = std::min(seen_low, v), seen_high = std::max(seen_high, v);
      }
      if (degree - order <= 1) {  // linear or constant between: control points are values
        EXPECT_NEAR(seen_low, low, 0.05 * (high - low));
        EXPECT_NEAR(seen_high, high, 0.05 * (high - low));
      }
    }
  }
}

TEST(SplineSpace, LinesAreReproducedByGrevillesPlaces) {
  Random random(3);
  const SplineSpace space(3, test::random_knots(random, 3, 5, 2, 1));
  std::vector<double> d;
  for (std::size_t i = 0; i < space.size(); ++i) d.push_back(4 + 3 * space.greville(i));
  const TimeSpline s = space.spline(d);
  for (int i = 0; i <= 20; ++i) EXPECT_NEAR(s.in_piece(s.find(0.05 * i, 0), 0.05 * i).x, 4 + 0.15 * i, 1e-13);
}

TEST(SplineSpace, RefusesOtherDegrees) {
  EXPECT_THROW(SplineSpace(6, std::vector<double>(14, 0.0)), std::invalid_argument);
  EXPECT_THROW(SplineSpace(3, {0, 0, 0, 1, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
