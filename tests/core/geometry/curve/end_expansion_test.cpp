#include "core/geometry/curve/end_expansion.hpp"

#include "core/geometry/curve/curvature.hpp"
#include "core/geometry/path/regular.hpp"
#include "tests/core/geometry/support.hpp"

namespace bahnwerk {
namespace {

using testing::expect_near;

TEST(EndExpansion, HoldsWhereTheCurvatureIsBoundedAndItsRateIsNot) {
  // (u³, u⁷): y = x^(7/3), κ = 28/9 u/q^(3/2) with q = 1 + 49/9 u⁸, ds = 3u² √q du.
  const auto pieces = regular_pieces(Rational::from_power_basis({{0, 0, 0, 1}, {0, 0, 0, 0, 0, 0, 0, 1}}));
  ASSERT_EQ(pieces.size(), 1U);
  const EndExpansion expansion(pieces[0]);
  EXPECT_FALSE(expansion.unbounded());
  for (double u = 0.06; u > 1e-10; u *= 0.5) {
    ASSERT_TRUE(expansion.covers(u));
    Jet point = pieces[0].at(u);
    expansion.derivatives(u, point);
    const double bend = 49.0 / 9 * std::pow(u, 8), q = 1 + bend, kappa = 28.0 / 9 * u / (q * std::sqrt(q));
    const double rate = 28.0 / 27 * (1 - 12 * bend / q) / (q * q * u * u);
    EXPECT_NEAR(curvature(point), kappa, 1e-13 * kappa);
    EXPECT_NEAR(curvature_rate(point), rate, 1e-12 * rate);
  }
  Jet point = pieces[0].at(0);
  expansion.derivatives(0, point);
  EXPECT_EQ(point.d1, (Vec{1, 0, 0}));
  EXPECT_EQ(point.d2, Vec{});
  EXPECT_EQ(point.d3, Vec{});
  EXPECT_FALSE(expansion.covers(0.5));
}

TEST(EndExpansion, RationalAtEitherEnd) {
  // Weights cⁱ only change the parameter of (t², t³): t = cρ/(1 − ρ + cρ), κ = 6/(t (4 + 9t²)^(3/2)).
  const Vec a{0, 0, 0}, b{1.0 / 3, 0, 0}, c{1, 1, 0};
  for (double ratio : {0.3, 1.0, 4.0}) {
    const std::vector<double> weights{1, ratio, ratio * ratio, ratio * ratio * ratio};
    for (bool backwards : {false, true}) {
      std::vector<Vec> points{a, a, b, c};
      std::vector<double> w = weights;
      if (backwards) {
        std::reverse(points.begin(), points.end());
        std::reverse(w.begin(), w.end());
      }
      const auto pieces = regular_pieces(Rational::bezier(points, w));
      ASSERT_EQ(pieces.size(), 1U);
      const EndExpansion expansion(pieces[0]);
      EXPECT_TRUE(expansion.unbounded());
      for (double rho = 0.06; rho > 1e-7; rho *= 0.4) {
        const double u = backwards ? 1 - rho : rho;
        Jet point = pieces[0].at(u);
        expansion.derivatives(u, point);
        const double exact = backwards ? 1 - u : u, t = ratio * exact / (1 - exact + ratio * exact);
        const double q = 4 + 9 * t * t, kappa = 6 / (t * q * std::sqrt(q));
        EXPECT_NEAR(curvature(point), kappa, 1e-12 * kappa);
        expect_near(point.d1, (backwards ? -1 : 1) * Vec{2, 3 * t, 0} / std::sqrt(q), 1e-14);
        EXPECT_GT(point.d2.y, 0);
      }
    }
  }
}

TEST(EndExpansion, MeetsTheOrdinaryFormulaWhereItStops) {
  Random random(71);
  for (int i = 0; i < 300; ++i) {
    std::vector<Vec> points(2, testing::random_point(random, false));
    if (random.chance(0.4)) points.push_back(points[0]);
    while (points.size() < 6) points.push_back(testing::random_point(random, false));
    std::vector<double> weights;
    for (int k = 0; k < 6; ++k) weights.push_back(random.uniform(0.5, 2));
    const auto pieces = regular_pieces(Rational::bezier(points, weights));
    const EndExpansion expansion(pieces[0]);
    const double u = pieces[0].reach() / 16;
    ASSERT_TRUE(expansion.covers(u));
    const Jet plain = by_arc_length(pieces[0].at(u));
    Jet point = plain;
    expansion.derivatives(u, point);
    expect_near(point.d1, plain.d1, 1e-12);
    expect_near(point.d2, plain.d2, 1e-10 * norm(plain.d2));
    expect_near(point.d3, plain.d3, 1e-9 * norm(plain.d3));
  }
}

}  // namespace
}  // namespace bahnwerk
