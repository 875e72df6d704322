#include "core/geometry/path/regular.hpp"

#include "tests/core/geometry/support.hpp"

namespace bahnwerk {
namespace {

/// Rows of (u − a)^k times row, by repeated multiplication.
Polynomial times_power(Polynomial row, double a, int k) {
  for (int i = 0; i < k; ++i) row = row * Polynomial{-a, 1.0};
  return row;
}
/// The antiderivative from 0.
Polynomial integral(const Polynomial& p) {
  Polynomial s(p.size() + 1, 0.0);
  for (std::size_t k = 0; k < p.size(); ++k) s[k + 1] = p[k] / static_cast<double>(k + 1);
  return s;
}

TEST(RegularPieces, OrdinaryCurvesStayWhole) {
  Random random(51);
  for (int i = 0; i < 500; ++i) {
    for (const Rational& piece : testing::random_nurbs(random).pieces()) {
      if (piece.degree() < 2) continue;
      EXPECT_EQ(regular_pieces(piece).size(), 1U);
    }
  }
}

TEST(RegularPieces, FindsInnerZerosOfAnyOrderAnywhere) {
  Random random(52);
  for (int i = 0; i < 1500; ++i) {
    const int order = 1 + static_cast<int>(random.below(4));
    const double at = random.uniform(0.01, 0.99);
    const auto row = [&] {
      return integral(times_power({random.normal(), random.normal(), random.normal()}, at, order));
    };
    const Rational curve = Rational::from_power_basis({row(), row()});
    const auto pieces = regular_pieces(curve);
    ASSERT_EQ(pieces.size(), 2U) << "order " << order << " at " << at;
    EXPECT_NEAR(pieces[0].end(), at, 1e-9);
    EXPECT_EQ(pieces[0].end(), pieces[1].begin());
    EXPECT_EQ(pieces[0].vanishing_end(), static_cast<std::size_t>(order));
    EXPECT_EQ(pieces[1].vanishing_begin(), static_cast<std::size_t>(order));
    EXPECT_EQ(pieces[0].speed(pieces[0].end()), 0);
    for (double u = 0; u <= 1; u += 0.05) {
      testing::expect_near(pieces[u < pieces[0].end() ? 0 : 1].at(u).value, curve.at(u).value, 3e-11 * curve.extent());
    }
  }
}

TEST(RegularPieces, FindsCuspsOfRationalCurves) {
  // The cubic (u − a)², (u − a)³ through any projective change of weights keeps its cusp.
  Random random(53);
  for (int i = 0; i < 300; ++i) {
    const double a = random.uniform(0.05, 0.95);
    const auto bernstein = [&](const Polynomial& p) {  // cubic power basis → Bézier
      return std::vector<double>{p[0], p[0] + p[1] / 3, p[0] + 2 * p[1] / 3 + p[2] / 3, p[0] + p[1] + p[2] + p[3]};
    };
    const Polynomial w{1, random.uniform(-0.5, 0.5), random.uniform(0, 0.5), 0};
    const auto bw = bernstein(w), bx = bernstein(times_power({1.0, 0.0}, a, 2)),
               by = bernstein(times_power({1.0}, a, 3));
    std::vector<Vec> points;
    for (std::size_t k = 0; k < 4; ++k) points.push_back(Vec{bx[k], by[k], 0} / bw[k]);
    const auto pieces = regular_pieces(Rational::bezier(points, bw));
    ASSERT_EQ(pieces.size(), 2U) << a;
    EXPECT_NEAR(pieces[0].end(), a, 1e-9);
    EXPECT_EQ(pieces[1].vanishing_begin(), 1U);
  }
}

TEST(RegularPieces, SeveralZerosAndBothEnds) {
  // Doubled end points: vanishing at both ends, cut in the middle.
  const auto doubled = regular_pieces(Rational::bezier({{0, 0, 0}, {0, 0, 0}, {5, 9, 0}, {10, 0, 0}, {10, 0, 0}}));
  ASSERT_EQ(doubled.size(), 2U);
  EXPECT_EQ(doubled[0].vanishing_begin(), 1U);
  EXPECT_EQ(doubled[1].vanishing_end(), 1U);
  EXPECT_EQ(doubled[0].end(), 0.5);
  const Polynomial product = times_power(times_power({1.0}, 0.3, 1), 0.7, 2);
  const auto three =
      regular_pieces(Rational::from_power_basis({integral(product), integral(product * Polynomial{1.0, 2.0})}));
  ASSERT_EQ(three.size(), 4U);  // the middle one vanishes at both ends
  EXPECT_NEAR(three[0].end(), 0.3, 1e-10);
  EXPECT_NEAR(three[3].begin(), 0.7, 1e-8);
  EXPECT_EQ(three[3].vanishing_begin(), 2U);
}

TEST(RegularPieces, AlmostACuspIsCutToo) {
  // (τ², 2e-9 τ + τ³): the speed falls to 2e-9, not to 0.
  const double a = 0.4, e = 2e-9;
  const auto pieces =
      regular_pieces(Rational::from_power_basis({{a * a, -2 * a, 1}, {-e * a - a * a * a, e + 3 * a * a, -3 * a, 1}}));
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(pieces[0].end(), a, 1e-6);
  EXPECT_EQ(pieces[0].vanishing_end(), 0U);
}

TEST(RegularPieces, APointIsOnePiece) {
  EXPECT_EQ(regular_pieces(Rational::bezier({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}})).size(), 1U);
}

TEST(RegularPieces, CutsWhereACurveTurnsRoundWithinNanometres) {
  Random random(57);
  for (int i = 0; i < 300; ++i) {
    // There and back along x while y creeps on: the tangent is (0, width) at `at`, with the curvature 2 slope/width².
    const double at = random.uniform(0.02, 0.98), slope = 100, width = std::pow(10, random.uniform(-9, -3.2)),
                 bent = random.chance(0.5) ? 0.2 : 0;
    const Rational curve = Rational::from_power_basis({{0, -2 * slope * at, slope}, {0, width, 0, bent * width}});
    const auto pieces = regular_pieces(curve);
    ASSERT_EQ(pieces.size(), 2U) << width << " at " << at;
    EXPECT_NEAR(pieces[0].end(), at, 1e-9);
    EXPECT_EQ(pieces[0].vanishing_end(), 0U);
    EXPECT_EQ(pieces[0].pivot(), pieces[0].end());
    EXPECT_EQ(pieces[1].pivot(), pieces[0].end());
    EXPECT_NEAR(pieces[1].speed(pieces[1].begin()), width * (1 + 3 * bent * at * at), 1e-3 * width);
  }
  // Wider than that it is a curve like any other.
  EXPECT_EQ(regular_pieces(Rational::from_power_basis({{0, -100, 100}, {0, 0.1}})).size(), 1U);
}

}  // namespace
}  // namespace bahnwerk
