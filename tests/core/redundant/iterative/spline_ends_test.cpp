#include "core/redundant/iterative/spline_ends.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/core/redundant/iterative/random_knots.hpp"

namespace bahnwerk {
namespace {

TEST(SplineEnds, HoldWhateverTheVariablesAre) {
  Random random(1);
  for (std::size_t degree = 2; degree <= 5; ++degree)
    for (const int order : {2, 3}) {
      if (order == 3 && degree < 3) continue;
      const SplineSpace space(degree, test::random_knots(random, degree, 6, 1, 2));
      const SplineBegin begin{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), order};
      const SplineEnds ends(space, begin);
      std::vector<double> y(ends.variables());
      for (double& v : y) v = random.uniform(-1, 1);
      const std::vector<double> d = ends.controls(y);
      EXPECT_EQ(d.size(), space.size());
      for (std::size_t i = 0; i < y.size(); ++i) EXPECT_EQ(d[ends.control(i)], y[i]);
      const TimeSpline s = space.spline(d);
      const AxisState a = s.in_piece(0, 0), b = s.in_piece(s.pieces() - 1, s.duration());
      EXPECT_NEAR(a.x, begin.position, 1e-13);
      EXPECT_NEAR(a.v, begin.velocity, 1e-11);
      EXPECT_NEAR(b.v, 0, 1e-11);
      if (order == 3) {
        EXPECT_NEAR(a.a, begin.acceleration, 1e-9);
        EXPECT_NEAR(b.a, 0, 1e-9);
      }
      // Rows of variables are rows of control points.
      std::size_t span = 0;
      for (int i = 0; i <= 40; ++i)
        for (std::size_t derivative = 0; derivative <= 2; ++derivative) {
          const SplineRow row = space.at(0.05 * i, derivative, span);
          const VariableRow reduced = ends.reduced(row);
          double sum = 0, own = reduced.offset;
          for (std::size_t r = 0; r < row.count; ++r) sum += row.weights[r] * d[row.first + r];
          for (std::size_t r = 0; r < reduced.count; ++r) own += reduced.weights[r] * y[reduced.first + r];
          EXPECT_NEAR(own, sum, 1e-9);
        }
    }
}

TEST(SplineEnds, TakeSomeControlPoints) {
  EXPECT_THROW(SplineEnds(SplineSpace(2, {0, 0, 0, 1, 1, 1}), {}), std::invalid_argument);
  EXPECT_EQ(SplineEnds(SplineSpace(3, {0, 0, 0, 0, 1, 1, 1, 1}), {}).variables(), 1u);
}

TEST(SplineEnds, EndsAtRestWhereItIsTold) {
  const SplineSpace space(3, {0, 0, 0, 0, 0.5, 1, 1.5, 2, 2, 2, 2});
  for (const bool accelerated : {false, true}) {
    SplineBegin begin{1, 2, accelerated ? 3.0 : 0, accelerated ? 3 : 2, {}};
    const std::size_t free = SplineEnds(space, begin).variables();
    begin.end = 7;
    const SplineEnds ends(space, begin);
    ASSERT_EQ(ends.variables() + 1, free);
    const std::vector<double> y(ends.variables(), -4);
    const TimeSpline s = space.spline(ends.controls(y));
    const AxisState x = s.in_piece(s.pieces() - 1, 2);
    EXPECT_NEAR(x.x, 7, 1e-12);
    EXPECT_NEAR(x.v, 0, 1e-12);
    if (accelerated) {
      EXPECT_NEAR(x.a, 0, 1e-11);
    }
    std::size_t span = 0;  // rows agree with the spline
    for (const double t : {0.1, 0.9, 1.4, 1.9}) {
      const VariableRow row = ends.reduced(space.at(t, 0, span));
      double sum = row.offset;
      for (std::size_t r = 0; r < row.count; ++r) sum += row.weights[r] * y[row.first + r];
      EXPECT_NEAR(sum, s.in_piece(s.find(t, 0), t).x, 1e-12);
    }
  }
}

}  // namespace
}  // namespace bahnwerk
