// The speed as a B-spline along the path: against difference quotients, and how it leaves rest.
#include "core/motion/feed/speed_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/numeric/random.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk {
namespace {

using State = SpeedSpline::State;

SpeedSpline spline() { return SpeedSpline({0, 1, 2, 4, 7, 7.5, 9, 12, 15, 20}, 2); }

std::vector<double> controls(const SpeedSpline& s, Random& random) {
  std::vector<double> c(s.points(), 0.0);
  for (std::size_t i = SpeedSpline::fixed; i + SpeedSpline::fixed < c.size(); ++i) c[i] = random.uniform(5, 10);
  return c;
}

TEST(SpeedSpline, GoesFromEndToEndWithoutGaps) {
  const SpeedSpline s = spline();
  EXPECT_EQ(s.spans(), 9U);
  EXPECT_EQ(s.points(), 12U);
  EXPECT_EQ(s.at(0, 0).s, 0);
  EXPECT_EQ(s.at(8, 1).s, 20);
  EXPECT_NEAR(s.at(1, 1).s, 2, 1e-14);   // graded: where the second span ends, not the first
  EXPECT_NEAR(s.at(7, 0).s, 12, 1e-14);  // likewise
  EXPECT_NEAR(s.at(4, 0.5).s, 7.25, 1e-14);
  Random random(1);
  const std::vector<double> c = controls(s, random);
  for (std::size_t i = 0; i + 1 < s.spans(); ++i) {
    const auto left = s.at(i, 1), right = s.at(i + 1, 0);
    EXPECT_NEAR(left.s, right.s, 1e-13);
    EXPECT_NEAR(left.s1, right.s1, 1e-13);
    EXPECT_NEAR(left.s2, right.s2, 1e-13);
    const State x = SpeedSpline::state(left, c), y = SpeedSpline::state(right, c);
    EXPECT_NEAR(x.v, y.v, 1e-12);
    EXPECT_NEAR(x.a, y.a, 1e-10);
    EXPECT_NEAR(x.j, y.j, 1e-8);
  }
}

TEST(SpeedSpline, BasesAreAPartitionOfUnity) {
  const SpeedSpline s = spline();
  for (std::size_t i = 0; i < s.spans(); ++i)
    for (const double x : {0.0, 0.3, 1.0}) {
      const auto p = s.at(i, x);
      double sums[3] = {};
      for (std::size_t k = 0; k < SpeedSpline::order; ++k) sums[0] += p.b0[k], sums[1] += p.b1[k], sums[2] += p.b2[k];
      EXPECT_NEAR(sums[0], 1, 1e-14);
      EXPECT_NEAR(sums[1], 0, 1e-13);
      EXPECT_NEAR(sums[2], 0, 1e-12);
    }
}

TEST(SpeedSplineProperty, StatesAreDerivativesByTime) {
  const SpeedSpline s = spline();
  Random random(2);
  for (int n = 0; n < testing::cases(500); ++n) {
    const std::vector<double> c = controls(s, random);
    const std::size_t span = random.below(s.spans());
    const double x = random.uniform(0.1, 0.9), h = 1e-5;
    const auto at = [&](double y) { return s.at(span, y); };
    const auto state = [&](double y) { return SpeedSpline::state(at(y), c); };
    const State here = state(x), before = state(x - h), after = state(x + h);
    const double ds = at(x + h).s - at(x - h).s, dw = 2 * h * s.width(span);
    EXPECT_NEAR(ds / dw, at(x).s1, 1e-8 * (1 + at(x).s1));
    EXPECT_NEAR((at(x + h).s1 - at(x - h).s1) / dw, at(x).s2, 1e-7 * (1 + std::abs(at(x).s2)));
    // a = v dv/ds, j = v da/ds
    EXPECT_NEAR((after.v - before.v) / ds * here.v, here.a, 1e-6 * (1 + std::abs(here.a)));
    EXPECT_NEAR((after.a - before.a) / ds * here.v, here.j, 1e-5 * (1 + std::abs(here.j)));
  }
}

TEST(SpeedSplineProperty, SlopesByTheControlPoints) {
  const SpeedSpline s = spline();
  Random random(3);
  for (int n = 0; n < testing::cases(500); ++n) {
    std::vector<double> c = controls(s, random);
    const auto place = s.at(1 + random.below(s.spans() - 2), random.uniform(0, 1));  // next to rest slopes are steep
    const State here = SpeedSpline::state(place, c);
    const std::size_t k = random.below(SpeedSpline::order);
    const double h = 1e-5;
    c[place.span + k] += h;
    const State after = SpeedSpline::state(place, c);
    c[place.span + k] -= 2 * h;
    const State before = SpeedSpline::state(place, c);
    EXPECT_NEAR((after.v - before.v) / (2 * h), here.dv[k], 1e-9);
    EXPECT_NEAR((after.a - before.a) / (2 * h), here.da[k], 1e-7 * (1 + std::abs(here.da[k])));
    EXPECT_NEAR((after.j - before.j) / (2 * h), here.dj[k], 1e-6 * (1 + std::abs(here.dj[k])));
  }
}

/// s = q t⁴/24: v² : s a = 4 : 3, j s : a v = 1 : 2, at both ends.
TEST(SpeedSpline, LeavesRestAtConstantSnap) {
  const SpeedSpline s = spline();
  Random random(4);
  const std::vector<double> c = controls(s, random);
  for (const bool start : {true, false}) {
    const auto place = start ? s.at(0, 0.01) : s.at(8, 0.99);
    const double way = start ? place.s : 20 - place.s, sign = start ? 1 : -1;
    const State x = SpeedSpline::state(place, c);
    EXPECT_NEAR(x.v * x.v / (sign * x.a * way), 4.0 / 3, 0.02);
    EXPECT_NEAR(sign * x.j * way / (x.a * x.v), 0.5, 0.02);
    EXPECT_LT(std::abs(x.j), 0.03 * std::abs(SpeedSpline::state(s.at(start ? 0 : 8, 0.5), c).j));
  }
}

TEST(SpeedSpline, RefusesWhatIsNoSpline) {
  EXPECT_THROW(SpeedSpline({0, 1, 2, 3}, 1), std::invalid_argument);
  EXPECT_THROW(SpeedSpline({0, 1, 1, 3, 4}, 1), std::invalid_argument);
  EXPECT_THROW(SpeedSpline({0, 1, 2, 3, 4}, 3), std::invalid_argument);
  EXPECT_THROW(SpeedSpline({0, 1, 2, 3, 4}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
