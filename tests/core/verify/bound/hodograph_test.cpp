// Enclosures of a rational curve's direction and bends: they hold everything that samples find, and close in on it.
#include "core/verify/bound/hodograph.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/geometry/curve/curvature.hpp"

namespace bahnwerk::verify {
namespace {

Rational random_curve(std::mt19937_64& random, std::size_t degree, bool weighted, bool space) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec> points;
  std::vector<double> weights;
  for (std::size_t k = 0; k <= degree; ++k) {
    points.push_back(
        {10 * static_cast<double>(k) + 8 * uniform(random), 20 * uniform(random), space ? 15 * uniform(random) : 0});
    weights.push_back(std::exp(uniform(random)));
  }
  return Rational::bezier(points, weighted ? weights : std::vector<double>{});
}

TEST(Hodograph, HoldsWhatSamplesFind) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const std::size_t degree : {2u, 3u, 5u, 12u, 24u})
    for (int i = 0; i < 40; ++i) {
      const Rational curve = random_curve(random, degree, i % 2, i % 4 > 1);
      Hodograph hodograph(curve);
      for (const double width : {1.0, 0.1, 0.01, 1e-4}) {
        const double u0 = unit(random) * (1 - width), u1 = u0 + width;
        const Hodograph::Range range = hodograph.range(u0, u1);
        const Hodograph::DerivativeBounds derivative_bounds = hodograph.derivative_bounds(u0, u1);
        for (int j = 0; j <= 40; ++j) {
          const Jet h = by_arc_length(curve.at(u0 + (u1 - u0) * j / 40));
          const double rounding_error = degree > 5 ? 1e-7 : 1e-12;  // of the sample: the power basis costs digits
          for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_GE(h.d1[k], range.low[k] - rounding_error) << degree << " " << width;
            EXPECT_LE(h.d1[k], range.high[k] + rounding_error) << degree << " " << width;
          }
          EXPECT_LE(norm(h.d2), derivative_bounds.second * (1 + 1e-6)) << degree << " " << width;
          EXPECT_LE(norm(h.d3), derivative_bounds.third * (1 + 1e-6)) << degree << " " << width;
        }
      }
    }
}

TEST(Hodograph, ClosesIn) {
  std::mt19937_64 random(12);
  for (int i = 0; i < 40; ++i) {
    const Rational curve = random_curve(random, 3, i % 2, false);
    Hodograph hodograph(curve);
    const double u = 0.3, width = 1e-5;
    const Jet h = by_arc_length(curve.at(u));
    const Hodograph::Range range = hodograph.range(u - width, u + width);
    const double turn = norm(h.d2) * curve.speed(u) * width;
    for (std::size_t k = 0; k < 2; ++k) EXPECT_LE(range.high[k] - range.low[k], 2.5 * turn + 1e-9);
    const Hodograph::DerivativeBounds derivative_bounds = hodograph.derivative_bounds(u - width, u + width);
    EXPECT_NEAR(derivative_bounds.second, norm(h.d2), 1e-2 * norm(h.d2) + 1e-6);
  }
}

TEST(Hodograph, AMonotoneComponentHasNoWrongSignNextToItsRoot) {
  // y' vanishes at u = 1/2 and nowhere else.
  const Rational curve = Rational::from_power_basis({{0, 10, 3}, {0, -4, 4, 0}});
  Hodograph hodograph(curve);
  for (const double width : {0.5, 0.1, 1e-3, 1e-6}) {
    EXPECT_GE(hodograph.range(0.5, 0.5 + width).low[1], -1e-13);
    EXPECT_LE(hodograph.range(0.5 - width, 0.5).high[1], 1e-13);
  }
}

TEST(Hodograph, NothingIsKnownWhereTheTangentVanishes) {
  const Rational cusp = Rational::bezier({{1, -1, 0}, {-1.0 / 3, 1, 0}, {-1.0 / 3, -1, 0}, {1, 1, 0}});
  Hodograph hodograph(cusp);
  const Hodograph::Range range = hodograph.range(0.4, 0.7);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(range.low[k], -1);
    EXPECT_EQ(range.high[k], 1);
  }
  EXPECT_TRUE(std::isinf(hodograph.derivative_bounds(0.4, 0.7).second));
}

}  // namespace
}  // namespace bahnwerk::verify
