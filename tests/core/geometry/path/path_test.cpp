#include "core/geometry/path/path.hpp"

#include <algorithm>
#include <numbers>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/curvature.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/geometry/curve/reversed.hpp"
#include "tests/core/geometry/support.hpp"

namespace bahnwerk {
namespace {

using testing::expect_near;

Path path_of(const Rational& curve) {
  Path path;
  path.append(std::make_shared<Rational>(curve), 0);
  return path;
}
Path path_of(const std::vector<std::vector<double>>& rows) { return path_of(Rational::from_power_basis(rows)); }

TEST(Segment, DerivativesByArcLengthOfEveryKind) {
  const std::vector<std::shared_ptr<const Curve>> curves{
      std::make_shared<Line>(Vec{1, 2, 3}, Vec{4, 0, 1}),
      std::make_shared<Arc>(Vec{1, 2, 0}, Vec{1, 0, 0}, Vec{0, 1, 0}, 5, 2.2),
      std::make_shared<Arc>(Vec{1, 2, 0}, Vec{1, 0, 0}, Vec{0, 1, 0}, 5, -2.2, 4),
      std::make_shared<Rational>(Rational::bezier({{0, 0, 0}, {1, 2, 0}, {3, -1, 0}, {4, 1, 0}})),
      std::make_shared<Rational>(Rational::bezier({{0, 0, 0}, {1, 2, 1}, {3, -1, 2}, {4, 1, 0}}, {1, 2, 0.5, 1}))};
  for (const auto& curve : curves) {
    const Segment segment(curve, 100, 7);
    EXPECT_EQ(segment.source(), 7U);
    EXPECT_EQ(segment.s0(), 100);
    testing::expect_consistent([&](double s) { return segment.at(s); }, segment.s0(), segment.s1(), 2e-9);
    for (double s = segment.s0(); s <= segment.s1(); s += 0.1) {
      const PathPoint p = segment.at(s);
      EXPECT_NEAR(norm(p.d1), 1, 1e-15);
      EXPECT_NEAR(dot(p.d1, p.d2), 0, 1e-14);
      EXPECT_NEAR(dot(p.d1, p.d3), -dot(p.d2, p.d2), 1e-12 * (1 + norm(p.d3)));
    }
  }
}

TEST(Segment, RandomNurbsPropertyOfEveryPoint) {
  Random random(61);
  for (int i = 0; i < 300; ++i) {
    for (const Rational& piece : testing::random_nurbs(random).pieces()) {
      const Path path = path_of(piece);
      const double length = path.length();
      if (path.size() == 2) {  // cut where it turns round within a hundred millionth of its length
        const Jet at = piece.at(path[0].curve().end());
        const double speed = norm(at.d1);
        EXPECT_GT(norm(cross(at.d1, at.d2)) / (speed * speed * speed) * length, 1e8);
        continue;
      }
      ASSERT_EQ(path.size(), 1U);
      for (int k = 0; k <= 8; ++k) {
        const double s = length * k / 8;
        EXPECT_NEAR(path[0].arc_length(path[0].parameter(s)), s, 1e-12 * length);
        const PathPoint p = path.at(s);
        EXPECT_NEAR(norm(p.d1), 1, 1e-14);
      }
    }
  }
}

TEST(Segment, CircleAsRationalQuadraticHasItsCurvature) {
  const double h = std::sqrt(0.5), r = 10;
  const Segment segment(std::make_shared<Rational>(Rational::bezier({{r, 0, 0}, {r, r, 0}, {0, r, 0}}, {1, h, 1})), 0,
                        0);
  for (int k = 0; k <= 100; ++k) {
    const double phi = std::numbers::pi / 2 * k / 100;
    const PathPoint p = segment.at(r * phi);
    expect_near(p.value, r * Vec{std::cos(phi), std::sin(phi), 0}, 1e-13);
    expect_near(p.d1, Vec{-std::sin(phi), std::cos(phi), 0}, 1e-14);
    expect_near(p.d2, Vec{-std::cos(phi), -std::sin(phi), 0} / r, 1e-14);
    expect_near(p.d3, Vec{std::sin(phi), -std::cos(phi), 0} / (r * r), 1e-14);
  }
}

TEST(Segment, StraightIsExactlyStraight) {
  const Vec direction{0.6, 0.8, 0};
  for (const auto& curve : std::vector<std::shared_ptr<const Curve>>{
           std::make_shared<Line>(Vec{1, 1, 0}, Vec{4, 5, 0}),
           std::make_shared<Rational>(Rational::from_power_basis({{1, 0.3, 0.3, 2.4}, {1, 0.4, 0.4, 3.2}})),
           std::make_shared<Rational>(
               Rational::bezier({{1, 1, 0}, {1, 1, 0}, {2.5, 3, 0}, {4, 5, 0}}, {1, 2, 0.7, 1}))}) {
    Path path;
    path.append(curve, 0);
    ASSERT_EQ(path.size(), 1U);
    const Segment& segment = path[0];
    EXPECT_TRUE(segment.straight());
    EXPECT_FALSE(segment.cusp_begin());
    EXPECT_NEAR(segment.length(), 5, 1e-14);
    for (double s = 0; s <= 5; s += 0.25) {
      const PathPoint p = segment.at(s), q = segment.at_parameter(segment.parameter(s));
      EXPECT_EQ(p.d1, segment.at(0).d1);
      EXPECT_EQ(q.d1, segment.at(0).d1);
      EXPECT_EQ(p.d2, Vec{});
      EXPECT_EQ(q.d2, Vec{});
      EXPECT_EQ(p.d3, Vec{});
      expect_near(p.value, Vec{1, 1, 0} + s * direction, 1e-14);
      expect_near(q.value, p.value, 1e-14);
    }
    expect_near(segment.at(0).d1, direction, 1e-15);
  }
}

TEST(Segment, AStraightCurveThatTurnsBackIsSplit) {
  const Path path = path_of({{0, 1, -1}, {0, 2, -2}});  // out to u = 1/2 and back
  ASSERT_EQ(path.size(), 2U);
  EXPECT_TRUE(path[0].straight());
  EXPECT_TRUE(path[1].straight());
  EXPECT_NEAR(path.length(), std::sqrt(5.0) / 2, 1e-14);
  expect_near(path[0].at(0).d1 + path[1].at(path.length()).d1, {}, 1e-12);
}

TEST(Segment, TurningBackIsSeenFarFromTheOriginToo) {
  // 10 nm long, 8 m away: rounding of the coordinates (1e-12) bends the line and would hide the turns.
  const Vec a{8064.176530603122, 2629.1857752906822, 0}, b{8064.1765386630295, 2629.1857672307756, 0};
  const Path path = path_of(Rational::bezier({a, a, b, a, {8064.1765265731692, 2629.1857793206354, 0}, b, b}));
  ASSERT_GE(path.size(), 3U);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Segment& segment = path[i];
    EXPECT_TRUE(segment.straight());
    for (int k = 0; k <= 20; ++k) {
      const double s = segment.s0() + segment.length() * k / 20;
      expect_near(segment.at(s).value, segment.at_parameter(segment.parameter(s)).value, 1e-11);
    }
  }
}

TEST(Segment, SemicubicalCuspHasItsTangentAndItsFlag) {
  const Path path = path_of({{0, 0, 1}, {0, 0, 0, 1}});  // (u², u³)
  ASSERT_EQ(path.size(), 1U);
  EXPECT_TRUE(path[0].cusp_begin());
  EXPECT_FALSE(path[0].cusp_end());
  const PathPoint start = path.at(0);
  EXPECT_EQ(start.d1, (Vec{1, 0, 0}));
  EXPECT_EQ(start.d2, Vec{});
  EXPECT_EQ(start.d3, Vec{});
  for (double u = 1; u > 1e-9; u *= 0.37) {  // κ = 6/(u (4 + 9u²)^{3/2})
    const double q = 4 + 9 * u * u, kappa = 6 / (u * q * std::sqrt(q));
    EXPECT_NEAR(curvature(path[0].at_parameter(u)), kappa, 1e-12 * kappa) << u;
    EXPECT_NEAR(path[0].arc_length(u), (q * std::sqrt(q) - 8) / 27, 1e-15);
    // dκ/ds = −6 (4 + 36u²)/(u³ (4 + 9u²)³)
    const double rate = -6 * (4 + 36 * u * u) / (u * u * u * q * q * q);
    EXPECT_NEAR(curvature_rate(path[0].at_parameter(u)), rate, 1e-11 * std::abs(rate)) << u;
  }
}

TEST(Segment, HoldsWhereTheCurvatureIsBoundedAndItsRateIsNot) {
  // (u³, u⁷): y = x^(7/3), κ = 28/9 u/q^(3/2) with q = 1 + 49/9 u⁸, ds = 3u² √q du.
  const Path path = path_of({{0, 0, 0, 1}, {0, 0, 0, 0, 0, 0, 0, 1}});
  ASSERT_EQ(path.size(), 1U);
  EXPECT_FALSE(path[0].cusp_begin());
  for (double u = 0.06; u > 1e-10; u *= 0.5) {
    const PathPoint point = path[0].at_parameter(u);
    const double bend = 49.0 / 9 * std::pow(u, 8), q = 1 + bend, kappa = 28.0 / 9 * u / (q * std::sqrt(q));
    const double rate = 28.0 / 27 * (1 - 12 * bend / q) / (q * q * u * u);
    EXPECT_NEAR(curvature(point), kappa, 1e-13 * kappa);
    EXPECT_NEAR(curvature_rate(point), rate, 1e-12 * rate);
  }
  const PathPoint point = path[0].at_parameter(0);
  EXPECT_EQ(point.d1, (Vec{1, 0, 0}));
  EXPECT_EQ(point.d2, Vec{});
  EXPECT_EQ(point.d3, Vec{});
}

TEST(Segment, RationalCuspAtEitherEnd) {
  // Weights cⁱ only change the parameter of (t², t³): t = cρ/(1 − ρ + cρ), κ = 6/(t (4 + 9t²)^(3/2)).
  const Vec a{0, 0, 0}, b{1.0 / 3, 0, 0}, c{1, 1, 0};
  for (double ratio : {0.3, 1.0, 4.0})
    for (bool backwards : {false, true}) {
      std::vector<Vec> points{a, a, b, c};
      std::vector<double> weights{1, ratio, ratio * ratio, ratio * ratio * ratio};
      if (backwards) {
        std::reverse(points.begin(), points.end());
        std::reverse(weights.begin(), weights.end());
      }
      const Path path = path_of(Rational::bezier(points, weights));
      ASSERT_EQ(path.size(), 1U);
      EXPECT_TRUE(backwards ? path[0].cusp_end() : path[0].cusp_begin());
      for (double rho = 0.06; rho > 1e-7; rho *= 0.4) {
        const double u = backwards ? 1 - rho : rho;
        const PathPoint point = path[0].at_parameter(u);
        const double exact = backwards ? 1 - u : u, t = ratio * exact / (1 - exact + ratio * exact);
        const double q = 4 + 9 * t * t, kappa = 6 / (t * q * std::sqrt(q));
        EXPECT_NEAR(curvature(point), kappa, 1e-12 * kappa);
        expect_near(point.d1, (backwards ? -1 : 1) * Vec{2, 3 * t, 0} / std::sqrt(q), 1e-14);
        EXPECT_GT(point.d2.y, 0);
      }
    }
}

/// Next to a vanishing tangent the zeros are divided out; farther away the derivatives are quotients.
TEST(Segment, BothFormulasMeetBesideAVanishingTangent) {
  Random random(71);
  for (int i = 0; i < 300; ++i) {
    std::vector<Vec> points(2, testing::random_point(random, false));
    if (random.chance(0.4)) points.push_back(points[0]);
    while (points.size() < 6) points.push_back(testing::random_point(random, false));
    std::vector<double> weights;
    for (int k = 0; k < 6; ++k) weights.push_back(random.uniform(0.5, 2));
    const Path path = path_of(Rational::bezier(points, weights));
    const Curve& curve = path[0].curve();
    const double u = static_cast<const Rational&>(curve).reach() / 16;
    const Jet plain = by_arc_length(curve.at(u)), point = path[0].at_parameter(u);
    expect_near(point.d1, plain.d1, 1e-12);
    expect_near(point.d2, plain.d2, 1e-10 * norm(plain.d2));
    expect_near(point.d3, plain.d3, 1e-9 * norm(plain.d3));
  }
}

TEST(Segment, InnerCuspIsSplitWithBothFlags) {
  const double a = 0.37;  // (τ², τ³), τ = u − a
  const Path path = path_of({{a * a, -2 * a, 1}, {-a * a * a, 3 * a * a, -3 * a, 1}});
  ASSERT_EQ(path.size(), 2U);
  EXPECT_TRUE(path[0].cusp_end());
  EXPECT_TRUE(path[1].cusp_begin());
  EXPECT_FALSE(path[0].cusp_begin());
  expect_near(path[0].at_parameter(path[0].curve().end()).d1, Vec{-1, 0, 0}, 1e-10);
  expect_near(path[1].at_parameter(path[1].curve().begin()).d1, Vec{1, 0, 0}, 1e-10);
  EXPECT_EQ(path[0].source(), path[1].source());
  const double tau = 0.01, q = 4 + 9 * tau * tau;
  EXPECT_NEAR(curvature(path[0].at_parameter(a - tau)), 6 / (tau * q * std::sqrt(q)), 1e-7);
}

TEST(Segment, AParabolaThroughACubicParameterStaysSmooth) {
  // (u³, u⁶) from −1 to 1: y = x², with a vanishing tangent in the middle and no cusp. On [0, 1]: u → 2u − 1.
  const Polynomial cube = shifted({0.0, 0.0, 0.0, 1.0}, -1, 2),
                   sixth = shifted({0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}, -1, 2);
  const Path path = path_of({cube, sixth});
  ASSERT_EQ(path.size(), 2U);
  for (const Segment* segment : {&path[0], &path[1]}) {
    EXPECT_FALSE(segment->cusp_begin() || segment->cusp_end());
    for (double u = segment->curve().begin(); u <= segment->curve().end(); u += 0.003) {
      const PathPoint p = segment->at_parameter(u);
      const double x = p.value.x, q = 1 + 4 * x * x;
      EXPECT_NEAR(curvature(p), 2 / (q * std::sqrt(q)), 1e-10) << u;
      EXPECT_NEAR(curvature_rate(p), -24 * x / (q * q * q), 1e-7) << u;
      expect_near(p.d1, Vec{1, 2 * x, 0} / std::sqrt(q), 1e-12);
    }
  }
  expect_near(path[0].at_parameter(path[0].curve().end()).d2, Vec{0, 2, 0}, 1e-12);
  expect_near(path[1].at_parameter(path[1].curve().begin()).d2, Vec{0, 2, 0}, 1e-12);
  expect_near(path[1].at_parameter(path[1].curve().begin()).d3, Vec{-4, 0, 0}, 1e-9);  // −κ² T; dκ/ds = 0
}

TEST(Segment, DoubledAndTripledEndPoints) {
  const Vec a{0, 0, 0}, b{3, 4, 0}, c{10, 0, 0};
  const Path doubled = path_of(Rational::bezier({a, a, b, c}));
  ASSERT_EQ(doubled.size(), 1U);
  expect_near(doubled.at(0).d1, Vec{0.6, 0.8, 0}, 1e-15);
  EXPECT_TRUE(doubled[0].cusp_begin());  // κ ~ 1/u
  const Path end = path_of(Rational::bezier({c, b, a, a}));
  expect_near(end.at(end.length()).d1, Vec{-0.6, -0.8, 0}, 1e-15);
  EXPECT_TRUE(end[0].cusp_end());
  EXPECT_FALSE(end[0].cusp_begin());
  EXPECT_NEAR(end.length(), doubled.length(), 1e-13);
  const Path tripled = path_of(Rational::bezier({a, a, a, b, c}));
  expect_near(tripled.at(0).d1, Vec{0.6, 0.8, 0}, 1e-15);
  const Path both = path_of(Rational::bezier({a, a, b, c, c}));
  ASSERT_EQ(both.size(), 2U);
  expect_near(both[0].at(both[0].s1()).d1, both[1].at(both[1].s0()).d1, 1e-14);
  expect_near(both[0].at(both[0].s1()).d2, both[1].at(both[1].s0()).d2, 1e-13);
  const Path line = path_of(Rational::bezier({a, a, a, c, c}));  // doubled ends on a straight line
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_TRUE(line[i].straight());
}

TEST(Segment, ReadBackwardsTheGeometryIsTheSame) {
  Random random(62);
  for (int i = 0; i < 300; ++i) {
    std::vector<Vec> points{testing::random_point(random, false)};
    points.push_back(random.chance(0.5) ? points[0] : testing::random_point(random, false));
    if (random.chance(0.3)) points.push_back(points[1]);
    while (points.size() < 5) points.push_back(testing::random_point(random, false));
    std::vector<double> weights;
    for (std::size_t k = 0; k < 5; ++k) weights.push_back(random.uniform(0.5, 2));
    std::vector<Vec> back(points.rbegin(), points.rend());
    const Path a = path_of(Rational::bezier(points, weights));
    const Path b = path_of(Rational::bezier(back, {weights.rbegin(), weights.rend()}));
    EXPECT_NEAR(a.length(), b.length(), 1e-13 * a.length());
    for (int k = 1; k < 40; ++k) {
      const double s = a.length() * std::pow(k / 40.0, 3);
      const PathPoint p = a.at(s), q = b.at(b.length() - s);
      const double rounding =
          1e-11 * (1 + a.length() / s);  // s near a singular start is known to eps of the length only
      expect_near(p.value, q.value, 1e-12 * a.length());
      expect_near(p.d1, -q.d1, rounding, "d1");
      expect_near(p.d2, q.d2, rounding * (norm(p.d2) + 1), "d2");
      expect_near(p.d3, -q.d3, 10 * rounding * (norm(p.d3) + 1), "d3");
    }
    if (HasFailure()) FAIL() << "curve " << i;
  }
}

TEST(Segment, MicrometreAndMetre) {
  for (double size : {1e-6, 1e-3, 1e3, 1e4}) {
    const Path path =
        path_of(Rational::bezier({{0, 0, 0}, size * Vec{1, 2, 0}, size * Vec{3, -1, 0}, size * Vec{4, 1, 0}}));
    const double length = path.length();
    testing::expect_consistent([&](double s) { return path.at(s); }, 0, length, 1e-9);
  }
}

TEST(Segment, PanelParametersGradeTowardsADifficultEnd) {
  const Path path = path_of({{0, 0, 1}, {0, 0, 0, 1}});
  const auto u = path[0].panel_parameters();
  EXPECT_EQ(u.front(), 0);
  EXPECT_EQ(u.back(), 1);
  EXPECT_LT(u[1], 1e-8);
  EXPECT_TRUE(std::is_sorted(u.begin(), u.end()));
  const Segment line(std::make_shared<Line>(Vec{}, Vec{1, 0, 0}), 0, 0);
  EXPECT_EQ(line.panel_parameters(), (std::vector<double>{0, 1}));
}

TEST(Segment, RejectsCurvesWithoutLength) {
  const auto places = testing::fault_places([] { Segment(std::make_shared<Line>(Vec{1, 2, 3}, Vec{1, 2, 3}), 0, 0); });
  EXPECT_EQ(places.size(), 1U);
  Path path;
  EXPECT_THROW(path.append(std::make_shared<Rational>(Rational::bezier({{1, 1, 0}, {1, 1, 0}, {1, 1, 0}})), 0),
               InvalidInput);
  EXPECT_TRUE(path.empty());
  EXPECT_THROW(Segment(std::make_shared<Rational>(Rational::from_power_basis({{0, 1, -1}, {0, 2, -2}})), 0, 0),
               std::invalid_argument);
}

// At the end the tangent vanishes but for 2.5e-12: more than rounding of the curve as it is given, less than that of
// the piece, which is expanded about its begin.
TEST(Path, APieceIsNotCutAgain) {
  constexpr double left = 2.5e-12;
  Path path, copy, back;
  path.append(
      std::make_shared<Rational>(Rational::from_power_basis({{2, 0, 3, -2, -left, left}, {1, 0, 0.4, -0.8, 0.4}})), 7);
  ASSERT_EQ(path.size(), 1U);
  const Segment& one = path[0];
  EXPECT_TRUE(one.cusp_begin() && one.cusp_end());
  copy.append_piece(std::make_shared<Rational>(static_cast<const Rational&>(one.curve())), one.source());
  ASSERT_EQ(copy.size(), 1U);
  EXPECT_EQ(copy[0].source(), 7U);
  EXPECT_EQ(copy.length(), path.length());
  for (const double s : {0.0, 1e-9, 0.3, path.length()}) {
    EXPECT_EQ(copy.at(s).value, path.at(s).value);
    EXPECT_EQ(copy.at(s).d1, path.at(s).d1);
  }
  back.append_piece(reversed(one.curve()), one.source());
  ASSERT_EQ(back.size(), 1U);
  EXPECT_TRUE(back[0].cusp_begin() && back[0].cusp_end());
  EXPECT_NEAR(back.length(), path.length(), 1e-12);
  for (const double s : {0.0, 1e-9, 0.3, path.length()})
    EXPECT_LE(norm(back.at(path.length() - s).d1 + path.at(s).d1), 1e-5) << s;
}

TEST(Path, FindsTheSegmentWithAnyHint) {
  Path path;
  Random random(63);
  Vec at;
  for (int i = 0; i < 50; ++i) {
    const Vec next = at + Vec{random.uniform(0.1, 2), random.normal(), 0};
    path.append(std::make_shared<Line>(at, next), static_cast<std::size_t>(i));
    at = next;
  }
  for (int i = 0; i < 2000; ++i) {
    const double s = random.uniform(-1, path.length() + 1);
    const std::size_t found = path.find(s);
    if (s >= 0 && s < path.length()) {
      EXPECT_LE(path[found].s0(), s);
      EXPECT_LT(s, path[found].s1());
    }
    for (std::size_t hint : {std::size_t{0}, found, found + 1, static_cast<std::size_t>(random.below(60))}) {
      EXPECT_EQ(path.find(s, hint), found);
    }
  }
  for (std::size_t k = 0; k < 50; ++k) EXPECT_EQ(path.find(path[k].s0()), k);
  EXPECT_EQ(path.find(path.length()), 49U);
  expect_near(path.at(path.length()).value, at, 1e-12);
}

}  // namespace
}  // namespace bahnwerk
