#include "core/geometry/path/arc_length.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <numbers>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/path/regular.hpp"
#include "tests/core/geometry/support.hpp"

namespace bahnwerk {
namespace {

/// Arc length by adaptive Gauss–Kronrod quadrature of the speed from the jet: shares nothing with the table. Over
/// [−1, 1], since the rule holds errors that are not scaled by the interval against its tolerance.
double quadrature_length(const Curve& curve, double a, double b) {
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  const auto speed = [&](double x) { return norm(curve.at(middle + half * x).d1); };
  return half * boost::math::quadrature::gauss_kronrod<double, 61>::integrate(speed, -1.0, 1.0, 12, 1e-12);
}

/// s(u) monotone, ends right, and u(s(u)), s(u(s)) return to 1e-13 of the length.
void expect_round_trip(const ArcLength& table, const Curve& curve, int steps = 50) {
  const double length = table.length();
  EXPECT_EQ(table.at(curve.begin()), 0);
  EXPECT_EQ(table.at(curve.end()), length);
  EXPECT_EQ(table.inverse(0), curve.begin());
  EXPECT_EQ(table.inverse(length), curve.end());
  double before = 0;
  for (int i = 1; i < steps; ++i) {
    const double s = length * i / steps, u = table.inverse(s);
    EXPECT_NEAR(table.at(u), s, 1e-13 * length + curve.speed(u) * 4e-16 * std::abs(u));
    EXPECT_GE(u, before);
    before = u;
    const double v = curve.begin() + (curve.end() - curve.begin()) * i / steps, w = table.inverse(table.at(v));
    EXPECT_NEAR(table.at(w), table.at(v), 1e-13 * length + curve.speed(v) * 4e-16);
    for (const double apart : {0.0, 1e-4, 0.3, 20.0}) {
      const PointPair both{s, std::min(length, s + apart * length / steps)}, at = table.inverse(both);
      for (const std::size_t k : {0U, 1U})
        EXPECT_NEAR(table.at(at[k]), both[k], 1e-13 * length + curve.speed(at[k]) * 4e-16 * std::abs(at[k]));
    }
  }
}

TEST(ArcLength, LinesAndArcsInClosedForm) {
  const Line line({1, 2, 3}, {4, 6, 3});
  const Arc arc({}, {1, 0, 0}, {0, 1, 0}, 10, -2, 3);
  EXPECT_EQ(ArcLength(line).length(), 5);
  EXPECT_NEAR(ArcLength(arc).length(), std::hypot(20, 3), 1e-14);
  EXPECT_EQ(ArcLength(line).borders(), (std::vector<double>{0, 1}));
  expect_round_trip(ArcLength(line), line);
  expect_round_trip(ArcLength(arc), arc);
}

TEST(ArcLength, CircleOfRationalQuadratics) {
  const double h = std::sqrt(0.5), r = 10;
  const Rational quarter = Rational::bezier({{r, 0, 0}, {r, r, 0}, {0, r, 0}}, {1, h, 1});
  const ArcLength table(quarter);
  EXPECT_NEAR(table.length(), r * std::numbers::pi / 2, 1e-13);
  for (double u = 0; u <= 1; u += 0.01) {
    const Vec p = quarter.at(u).value;
    EXPECT_NEAR(table.at(u), r * std::atan2(p.y, p.x), 2e-13);
  }
}

TEST(ArcLength, Parabola) {
  const Rational parabola = Rational::from_power_basis({{0, 30}, {0, 0, 70}});
  const ArcLength table(parabola);
  for (double u = 0; u <= 1; u += 0.01) {  // ∫ √(30² + (140u)²)
    const double q = 140 * u / 30;
    EXPECT_NEAR(table.at(u), 30.0 * 30 / 140 * 0.5 * (q * std::sqrt(1 + q * q) + std::asinh(q)),
                1e-13 * table.length());
  }
}

TEST(ArcLength, StraightLineWithACubicParameter) {
  const Rational line = Rational::from_power_basis({{5, 1, 0.5, 2}, {0, 2, 1, 4}});
  const ArcLength table(line);
  for (double u = 0; u <= 1; u += 0.01)
    EXPECT_NEAR(table.at(u), std::sqrt(5.0) * (u + 0.5 * u * u + 2 * u * u * u), 1e-14);
}

TEST(ArcLength, RandomCurvesAgainstGaussKronrod) {
  Random random(41);
  double worst = 0;
  int pieces = 0;
  for (int i = 0; i < 2500; ++i) {
    for (const Rational& bezier : testing::random_nurbs(random).pieces()) {
      for (const Rational& piece : regular_pieces(bezier)) {
        const ArcLength table(piece);
        const double whole = quadrature_length(piece, piece.begin(), piece.end());
        worst = std::max(worst, std::abs(table.length() - whole) / whole);
        const double u = piece.begin() + random.uniform() * (piece.end() - piece.begin());
        worst = std::max(worst, std::abs(table.at(u) - quadrature_length(piece, piece.begin(), u)) / whole);
        expect_round_trip(table, piece, 10);
        ++pieces;
      }
    }
    if (HasFailure()) FAIL() << "curve " << i;
  }
  EXPECT_LT(worst, 1e-12);
  RecordProperty("pieces", pieces);
  RecordProperty("worst_relative_difference_1e_18", static_cast<int>(worst * 1e18));
}

TEST(ArcLength, AnySizeAndPlace) {
  const std::vector<Vec> shape{{0, 0, 0}, {1, 2, 0}, {3, -1, 0}, {4, 1, 0}};
  const double unit = ArcLength(Rational::bezier(shape)).length();
  for (double size : {1e-6, 1e-3, 1.0, 1e4}) {
    for (const Vec& offset : {Vec{}, Vec{1e4, -1e4, 0}}) {
      std::vector<Vec> points = shape;
      for (Vec& p : points) p = offset + size * p;
      const Rational curve = Rational::bezier(points);
      const ArcLength table(curve);
      EXPECT_NEAR(table.length(), size * unit, 1e-13 * size * unit + 1e-12 * (norm(offset) > 0 ? 4 : 0));
      expect_round_trip(table, curve);
    }
  }
}

TEST(ArcLength, StrongSpeedVariation) {
  const Rational spread = Rational::bezier({{0, 0, 0}, {1, 2, 0}, {3, -1, 0}, {4, 1, 0}}, {1e3, 1, 1, 1e-3});
  const Rational spike = Rational::from_power_basis({{0, 0, 1}, {0, -1e-5, 1e-5}});  // speed 1e-5 at the start
  for (const Rational* curve : {&spread, &spike}) {
    const ArcLength table(*curve);
    EXPECT_NEAR(table.length(), quadrature_length(*curve, 0, 1), 1e-11 * table.length());
    expect_round_trip(table, *curve, 500);
    EXPECT_GT(table.borders().size(), 10U);
  }
  // Quadrature in 40 decimal digits (mpmath) of the first; weights a factor of 1e6 apart cost four digits.
  EXPECT_NEAR(ArcLength(spread).length(), 5.2657280497538049, 1e-10 * 5.27);
}

TEST(ArcLength, KeepsRelativeAccuracyNextToAVanishingTangent) {
  for (std::size_t m = 1; m <= 4; ++m) {  // x = u^(m+1), y = u^(m+1): s = √2 u^(m+1)
    std::vector<double> row(m + 2, 0.0);
    row.back() = 1;
    const auto front = regular_pieces(Rational::from_power_basis({row, row}));
    ASSERT_EQ(front.size(), 1U);
    ASSERT_EQ(front[0].vanishing_begin(), m);
    const ArcLength table(front[0]);
    // On a panel s grows by 8^(m+1): that much is lost at its lower end.
    const double relative = 2.2e-16 * std::pow(8.0, static_cast<double>(m + 1)) + 1e-14;
    for (double u = 1; u > 1e-12; u *= 0.3) {
      const double s = std::sqrt(2.0) * std::pow(u, static_cast<double>(m + 1));
      EXPECT_NEAR(table.at(u), s, relative * s) << m << ' ' << u;
      EXPECT_NEAR(table.inverse(s), u, relative * u) << m << ' ' << u;
    }
    expect_round_trip(table, front[0]);
    // The same read backwards: u → 1 − u.
    std::vector<double> mirrored(m + 2);
    double binomial = 1;
    for (std::size_t k = 0; k < m + 2; ++k) {
      mirrored[k] = k % 2 == 0 ? binomial : -binomial;
      binomial = binomial * static_cast<double>(m + 1 - k) / static_cast<double>(k + 1);
    }
    const auto far = regular_pieces(Rational::from_power_basis({mirrored, mirrored}));
    ASSERT_EQ(far.size(), 1U);
    EXPECT_EQ(far[0].vanishing_end(), m);
    const ArcLength end(far[0]);
    EXPECT_NEAR(end.length(), std::sqrt(2.0), 1e-14);
    for (double u = 0; u <= 1; u += 0.01) {
      EXPECT_NEAR(end.at(u), std::sqrt(2.0) * (1 - std::pow(1 - u, static_cast<double>(m + 1))), 1e-14);
    }
    expect_round_trip(end, far[0]);
  }
}

}  // namespace
}  // namespace bahnwerk
