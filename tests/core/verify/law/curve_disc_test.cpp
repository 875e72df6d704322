// The bounds hold where they are claimed: the curve's derivatives by arc length evaluated at complex parameters, by
// other formulas than the bounds are made of.
#include "core/verify/law/curve_disc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/curvature.hpp"
#include "core/geometry/curve/rational.hpp"
#include "tests/core/verify/law/random_rational.hpp"

namespace bahnwerk::verify {
namespace {

using Complex = std::complex<double>;
using Jet3 = std::array<std::array<Complex, 3>, 4>;  // derivatives 0 … 3 of x, y, z by u

/// Derivatives of N/w at a complex u by Leibniz' rule.
Jet3 derivatives(const Rational& curve, Complex u) {
  const Complex t = (u - curve.pivot()) / curve.reach();
  const auto all = [&](Polynomial p) {
    std::array<Complex, 4> d{};
    double per = 1;
    for (Complex& value : d) {
      for (std::size_t k = p.size(); k-- > 0;) value = value * t + p[k];
      value *= per;
      per /= curve.reach();
      p = derivative(p);
    }
    return d;
  };
  const auto w = all(curve.weight());
  Jet3 jet;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto n = all(curve.coordinate(k));
    Complex h[4];
    h[0] = n[0] / w[0];
    h[1] = (n[1] - w[1] * h[0]) / w[0];
    h[2] = (n[2] - 2.0 * w[1] * h[1] - w[2] * h[0]) / w[0];
    h[3] = (n[3] - 3.0 * w[1] * h[2] - 3.0 * w[2] * h[1] - w[3] * h[0]) / w[0];
    for (std::size_t i = 0; i < 4; ++i) jet[i][k] = h[i];
  }
  return jet;
}

Complex dot(const std::array<Complex, 3>& a, const std::array<Complex, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Sizes of h′, h″, h‴ by arc length and of ds/du, by d/ds = (1/σ) d/du with σ² = h_u·h_u.
std::array<double, 4> sizes(const Jet3& h) {
  const Complex q = dot(h[1], h[1]), q1 = 2.0 * dot(h[1], h[2]), q2 = 2.0 * (dot(h[2], h[2]) + dot(h[1], h[3]));
  std::array<double, 3> sum{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Complex second = h[2][k] / q - h[1][k] * q1 / (2.0 * q * q);
    const Complex by_u = h[3][k] / q - h[2][k] * q1 / (q * q) - h[2][k] * q1 / (2.0 * q * q) -
                         h[1][k] * q2 / (2.0 * q * q) + h[1][k] * q1 * q1 / (q * q * q);
    sum[0] += std::norm(h[1][k]) / std::abs(q);
    sum[1] += std::norm(second);
    sum[2] += std::norm(by_u) / std::abs(q);
  }
  return {std::sqrt(sum[0]), std::sqrt(sum[1]), std::sqrt(sum[2]), std::sqrt(std::abs(q))};
}

void holds(const CurveDisc& disc, const std::array<double, 4>& size) {
  const double margin = 1 + 1e-9;
  EXPECT_LE(size[0], disc.first * margin);
  EXPECT_LE(size[1], disc.second * margin);
  EXPECT_LE(size[2], disc.third * margin + 1e-12);
  EXPECT_LE(size[3], disc.speed * margin);
  EXPECT_LE(1 / size[3], disc.pace * margin);
}

TEST(CurveDisc, BoundsHoldOfRandomRationalsAlmostCuspedOnesToo) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::size_t discs = 0;
  for (int round = 0; round < 300; ++round) {
    const Rational curve = test::random_rational(random, round);
    CurveDiscs all(curve);
    for (int i = 0; i <= 20; ++i) {
      const CurveDisc disc = all.about(i / 20.0);
      if (disc.radius == 0) continue;
      ++discs;
      for (int k = 0; k < 40; ++k) {
        const double out = k % 2 ? 0.999999 : std::sqrt(uniform(random));
        holds(disc,
              sizes(derivatives(curve, disc.centre + std::polar(out * disc.radius, 6.2831853 * uniform(random)))));
        if (testing::Test::HasFailure()) FAIL() << "round " << round << " at " << i / 20.0;
      }
    }
  }
  EXPECT_GT(discs, 6000u);
}

/// On the real axis the formulas of the test are those of the geometry.
TEST(CurveDisc, TheTestsOwnFormulasAreTheGeometrys) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 20; ++round) {
    const Rational curve = test::random_rational(random, round);
    const Jet real = by_arc_length(curve.at(0.3));
    const auto size = sizes(derivatives(curve, 0.3));
    EXPECT_NEAR(size[0], norm(real.d1), 1e-9);
    EXPECT_NEAR(size[1], norm(real.d2), 1e-6 * norm(real.d2));
    EXPECT_NEAR(size[2], norm(real.d3), 1e-6 * norm(real.d3));
    EXPECT_NEAR(size[3], curve.speed(0.3), 1e-9 * size[3]);
  }
}

TEST(CurveDisc, BoundsHoldOfArcsAndHelices) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double rise : {0.0, 7.0}) {
    const double radius = 3, sweep = -2.5;
    const Arc arc({1, 2, 3}, {1, 0, 0}, {0, 1, 0}, radius, sweep, rise);
    CurveDiscs all(arc);
    const CurveDisc disc = all.about(0.4);
    for (int k = 0; k < 200; ++k) {
      const Complex u = 0.4 + std::polar(disc.radius * std::sqrt(uniform(random)), 6.2831853 * uniform(random));
      const Complex s = std::sin(u * sweep), c = std::cos(u * sweep);
      const double r1 = radius * sweep, r2 = r1 * sweep, r3 = r2 * sweep;
      holds(disc, sizes({{{radius * c, radius * s, u * rise},
                          {-r1 * s, r1 * c, rise},
                          {-r2 * c, -r2 * s, 0},
                          {r3 * s, -r3 * c, 0}}}));
    }
  }
}

/// Neighbours share a disc, and it is worth having: a fraction of the distance to the next singularity.
TEST(CurveDisc, ReachesAFairPartOfTheWayToTheSingularity) {
  // Parabola (u, u²): ν² = 1 + 4u² vanishes at ±i/2.
  const Rational curve = Rational::from_power_basis({{0, 1}, {0, 0, 1}});
  CurveDiscs all(curve);
  EXPECT_GT(all.about(0.0).radius, 0.15);
  EXPECT_LT(all.about(0.0).radius, 0.5);
  EXPECT_GT(all.about(1.0).radius, 0.15);
  EXPECT_LT(all.about(1.0).radius, std::sqrt(1.25));
}

}  // namespace
}  // namespace bahnwerk::verify
