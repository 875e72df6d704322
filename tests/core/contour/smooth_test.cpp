#include "core/contour/blend/smooth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/blend/smooth_basis.hpp"
#include "core/geometry/curve/nurbs.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk::blending {
namespace {

TEST(SmoothBasis, AgreesWithNurbs) {
  const std::vector<double> breaks{0, 0.5, 0.7, 2, 2.1, 4};
  const std::vector<double> knots = clamped_knots(breaks);
  std::vector<Vec> points;
  for (int i = 0; i < 10; ++i) points.push_back({std::sin(2.0 * i), std::cos(3.0 * i), 0.1 * i});
  const Nurbs reference(5, points, {}, knots);
  TubeSpline spline;
  spline.knots = knots;
  spline.points = points;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    for (const double x : {0.0, 0.3, 0.9}) {
      const double t = breaks[k] + x * (breaks[k + 1] - breaks[k]);
      const Jet a = spline.at(k, t), b = reference.at(t);
      EXPECT_LE(norm(a.value - b.value), 1e-13);
      EXPECT_LE(norm(a.d1 - b.d1), 1e-11);
      EXPECT_LE(norm(a.d2 - b.d2), 1e-9);
      EXPECT_LE(norm(a.d3 - b.d3), 1e-7);
      // To the last digit: less is computed, nothing else.
      EXPECT_EQ(value_basis_at(knots, k, t)[0], basis_at(knots, k, t)[0]);
      for (const std::size_t order : {0, 1, 2})
        EXPECT_EQ(second_derivative_basis_at(knots, k, t)[order], basis_at(knots, k, t)[order]);
      const auto third = third_basis_at<2>(knots, k, {t, breaks[k + 1]});
      const BasisRow here = basis_at(knots, k, t), end = basis_at(knots, k, breaks[k + 1]);
      for (std::size_t i = 0; i < spline_order; ++i) {
        EXPECT_NEAR(third[0][i], here[3][i], 1e-9);
        EXPECT_NEAR(third[1][i], end[3][i], 1e-9);
      }
    }
}

TubeProblem noisy_arc(double radius, double noise, std::size_t breaks) {
  TubeProblem p;
  Random random(5);
  const double length = 12;
  for (std::size_t k = 0; k <= breaks; ++k)
    p.breaks.push_back(length * static_cast<double>(k) / static_cast<double>(breaks));
  p.scale.assign(breaks, 2 * length / static_cast<double>(breaks));
  for (int i = 1; i < 200; ++i) {
    const double t = length * i / 200;
    const Vec off{noise * random.uniform(-1, 1), noise * random.uniform(-1, 1), 0};
    p.sites.push_back({t, Vec{10 * std::sin(t / 10), 10 * (1 - std::cos(t / 10)), 0} + off, radius});
  }
  p.begin.jet.value = {};
  p.end.jet.value = {10 * std::sin(length / 10), 10 * (1 - std::cos(length / 10)), 0};
  return p;
}

TEST(Smooth, StaysInTheTubeAndForgetsTheNoise) {
  const TubeProblem p = noisy_arc(0.01, 0.004, 16);
  const TubeSpline s = smooth_in_tube(p, silent_scope());
  ASSERT_TRUE(s.inside);
  std::size_t span = 0;
  for (const TubeSite& site : p.sites) {
    while (span + 2 < p.breaks.size() && site.t >= p.breaks[span + 1]) ++span;
    const Jet f = s.at(span, site.t);
    EXPECT_LT(norm(f.value - site.p), site.radius);
    EXPECT_NEAR(norm(cross(f.d1, f.d2)) / std::pow(norm(f.d1), 3), 0.1, 0.03);
  }
}

TEST(Smooth, ClampedEndsKeepThreeDerivatives) {
  TubeProblem p = noisy_arc(0.01, 0.001, 16);
  p.begin = {true, {{}, {1, 0, 0}, {0, 0.1, 0}, {-0.01, 0, 0}}};
  const TubeSpline s = smooth_in_tube(p, silent_scope());
  ASSERT_TRUE(s.inside);
  const Jet f = s.at(0, 0);
  EXPECT_LE(norm(f.d1 - p.begin.jet.d1), 1e-13);
  EXPECT_LE(norm(f.d2 - p.begin.jet.d2), 1e-12);
  EXPECT_LE(norm(f.d3 - p.begin.jet.d3), 1e-11);
}

TEST(Smooth, SaysWhenTheTubeIsTooNarrow) {
  // Eight intervals cannot follow 40 waves.
  TubeProblem p = noisy_arc(1e-4, 0, 8);
  for (std::size_t i = 0; i < p.sites.size(); ++i) p.sites[i].p.y += i % 4 < 2 ? 0.05 : -0.05;
  EXPECT_FALSE(smooth_in_tube(p, silent_scope()).inside);
}

}  // namespace
}  // namespace bahnwerk::blending
