#include "core/redundant/iterative/time_spline.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TimeSpline parabolas() {
  TimeSpline s;
  s.append(1, {0, 0, 1, 0, 0, 0});   // t²
  s.append(3, {1, 2, -1, 0, 0, 0});  // 1 + 2 τ − τ²
  return s;
}

TEST(TimeSpline, GivesStatesFromEitherSide) {
  const TimeSpline s = parabolas();
  EXPECT_EQ(s.duration(), 3);
  EXPECT_EQ(s.find(0.5, 0), 0u);
  EXPECT_EQ(s.find(1, 0), 1u);
  EXPECT_EQ(s.find(0.5, 1), 0u);  // a hint that is too late
  const AxisState a = s.in_piece(0, 1), b = s.in_piece(1, 1);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.a, 2);
  EXPECT_EQ(b.a, -2);
}

TEST(TimeSpline, IsTheSamePolynomialFromAnywhere) {
  TimeSpline s;
  s.append(2, {1, -2, 3, 0.5, -0.25, 0.125});
  const TimeSpline::Coefficients c = s.from(0, 0.75);
  for (const double t : {0.75, 1.0, 1.9}) {
    double sum = 0, power = 1;
    for (const double k : c) sum += k * power, power *= t - 0.75;
    EXPECT_NEAR(sum, s.in_piece(0, t).x, 1e-14);
  }
  const AxisState x = s.in_piece(0, 0);
  EXPECT_EQ(x.j, 3);
}

TEST(TimeSpline, ContinuesWithPartOfAnother) {
  TimeSpline s = parabolas();
  s.append(parabolas(), 2, 5);
  EXPECT_EQ(s.pieces(), 4u);
  EXPECT_EQ(s.duration(), 5);
  EXPECT_EQ(s.begin(3), 4);
  EXPECT_EQ(s.in_piece(3, 4.5).x, 1 + 2 * 0.5 - 0.25);
}

TEST(TimeSpline, SlowsAsAWhole) {
  TimeSpline s;
  s.append(2, {1, -2, 3, 0.5, -0.25, 0.125});
  s.append(3, {4, 1, -1, 0.25, 0.5, -0.125});
  TimeSpline slow = s;
  slow.slow(1.5);
  EXPECT_EQ(slow.duration(), 4.5);
  EXPECT_EQ(slow.begin(1), 3);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
    for (const double part : {0.0, 0.3, 1.0}) {
      const double t = s.begin(i) + part * (s.end(i) - s.begin(i));
      const AxisState before = s.in_piece(i, t), after = slow.in_piece(i, 1.5 * t);
      EXPECT_NEAR(after.x, before.x, 1e-13);
      EXPECT_NEAR(after.v, before.v / 1.5, 1e-13);
      EXPECT_NEAR(after.a, before.a / 2.25, 1e-13);
      EXPECT_NEAR(after.j, before.j / 3.375, 1e-13);
    }
}

}  // namespace
}  // namespace bahnwerk
