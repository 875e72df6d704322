#include "core/geometry/curve/rational.hpp"

#include <limits>

#include "tests/core/geometry/support.hpp"

namespace bahnwerk {
namespace {

using testing::expect_near;
using testing::fault_places;
using Places = std::vector<std::string>;

struct LongPoint {
  long double x, y, z, w;
};
/// de Casteljau in extended precision.
Vec de_casteljau(const std::vector<Vec>& points, const std::vector<double>& weights, double u) {
  std::vector<LongPoint> row;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const long double w = weights.empty() ? 1 : weights[i];
    row.push_back({w * points[i].x, w * points[i].y, w * points[i].z, w});
  }
  const long double b = u, a = 1 - b;
  for (std::size_t left = row.size() - 1; left > 0; --left)
    for (std::size_t i = 0; i < left; ++i) {
      row[i] = {a * row[i].x + b * row[i + 1].x, a * row[i].y + b * row[i + 1].y, a * row[i].z + b * row[i + 1].z,
                a * row[i].w + b * row[i + 1].w};
    }
  const long double w = row[0].w;
  return {static_cast<double>(row[0].x / w), static_cast<double>(row[0].y / w), static_cast<double>(row[0].z / w)};
}

TEST(Rational, RandomBezierCurves) {
  Random random(21);
  for (int i = 0; i < 400; ++i) {
    const std::size_t n = 1 + random.below(8);
    const double size = std::pow(10.0, random.uniform(-6, 4));
    const bool planar = random.chance(0.5);
    std::vector<Vec> points;
    std::vector<double> weights;
    for (std::size_t k = 0; k <= n; ++k) points.push_back(testing::random_point(random, planar, size));
    if (random.chance(0.5))
      for (std::size_t k = 0; k <= n; ++k) weights.push_back(std::pow(10.0, random.uniform(-0.5, 0.5)));
    const Rational curve = Rational::bezier(points, weights);
    for (double u = 0; u <= 1; u += 0.0625) {
      expect_near(curve.at(u).value, de_casteljau(points, weights, u), 1e-13 * size * std::pow(1.5, n), "value");
      EXPECT_NEAR(curve.speed(u), norm(curve.at(u).d1), 1e-12 * curve.extent());
    }
    testing::expect_consistent([&](double u) { return curve.at(u); }, 0, 1, 1e-9);
    if (HasFailure()) FAIL() << "curve " << i << " degree " << n;
  }
}

TEST(Rational, PowerBasisIsTheContractsPolynomial) {
  const Rational curve = Rational::from_power_basis({{50, 0, 3}, {10, 20}, {1, 2, 3, 4}});
  for (double u = 0; u <= 1; u += 0.125) {
    const Jet jet = curve.at(u);
    expect_near(jet.value, Vec{50 + 3 * u * u, 10 + 20 * u, 1 + u * (2 + u * (3 + u * 4))}, 1e-13);
    expect_near(jet.d1, Vec{6 * u, 20, 2 + 6 * u + 12 * u * u}, 1e-13);
    expect_near(jet.d2, Vec{6, 0, 6 + 24 * u}, 1e-12);
    expect_near(jet.d3, Vec{0, 0, 24}, 1e-12);
  }
  EXPECT_FALSE(curve.rational());
}

TEST(Rational, EqualWeightsAreNoWeights) {
  const std::vector<Vec> points{{0, 0, 0}, {1, 2, 0}, {3, 1, 0}};
  const Rational plain = Rational::bezier(points), heavy = Rational::bezier(points, {7, 7, 7});
  EXPECT_FALSE(heavy.rational());
  EXPECT_EQ(plain.at(0.3).value, heavy.at(0.3).value);
}

TEST(Rational, HighDegreeWithinItsStatedRounding) {
  Random random(22);
  for (const std::size_t n : {16U, 24U}) {
    std::vector<Vec> points;
    for (std::size_t k = 0; k <= n; ++k) points.push_back(testing::random_point(random, false));
    const Rational curve = Rational::bezier(points);
    for (double u = 0; u <= 1; u += 0.0625)
      expect_near(curve.at(u).value, de_casteljau(points, {}, u), n == 16 ? 1e-10 : 1e-7);
  }
}

TEST(Rational, FarFromTheOriginTheDerivativesKeepTheirDigits) {
  const std::vector<Vec> here{{0, 0, 0}, {1, 2, 0}, {3, -1, 0}, {4, 1, 0}};
  std::vector<Vec> there = here;
  for (Vec& p : there) p += Vec{8192, -16384, 0};  // exact sums
  const std::vector<double> weights{1, 0.3, 4, 1};
  const Rational a = Rational::bezier(here, weights), b = Rational::bezier(there, weights);
  for (double u = 0; u <= 1; u += 0.125) {
    expect_near(a.at(u).d1, b.at(u).d1, 1e-13);
    expect_near(a.at(u).d3, b.at(u).d3, 1e-11);
    expect_near(b.at(u).value - a.at(u).value, {8192, -16384, 0}, 2 * 3.7e-12);  // an ulp of the coordinates, twice
  }
}

TEST(Rational, RestrictionIsTheSameCurve) {
  const Rational curve = Rational::bezier({{0, 0, 1}, {1, 2, 0}, {3, -1, 2}, {4, 1, 0}}, {1, 0.3, 4, 1});
  const Rational part = curve.restricted(0.25, 0.8, 0.25);
  EXPECT_EQ(part.begin(), 0.25);
  EXPECT_EQ(part.end(), 0.8);
  for (double u = 0.25; u <= 0.8; u += 0.05) {
    expect_near(part.at(u).value, curve.at(u).value, 1e-14);
    expect_near(part.at(u).d1, curve.at(u).d1, 1e-13);
    expect_near(part.at(u).d3, curve.at(u).d3, 1e-10);
    EXPECT_NEAR(part.speed(u), curve.speed(u), 1e-13);
  }
}

TEST(Rational, CollinearIsSeenAtAnyPlaceAndSize) {
  for (double size : {1e-5, 1.0, 1e4}) {
    for (Vec offset : {Vec{}, Vec{1e4, 1e4, 0}}) {
      std::vector<Vec> line, bent;
      for (double t : {0.0, 0.1, 0.7, 1.0}) {
        line.push_back(offset + size * t * Vec{0.6, 0.8, 0});
        bent.push_back(line.back());
      }
      bent[2] += 1e-4 * size * Vec{0.8, -0.6, 0};
      EXPECT_TRUE(Rational::bezier(line).collinear());
      EXPECT_TRUE(Rational::bezier(line, {1, 2, 3, 1}).collinear());
      EXPECT_FALSE(Rational::bezier(bent).collinear());
    }
  }
}

TEST(Rational, RejectsWhatIsNoCurve) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto power = [](std::vector<std::vector<double>> rows) {
    return fault_places([&] { Rational::from_power_basis(rows); });
  };
  EXPECT_EQ(power({{0, 1}}), Places{"/polynomial/coefficients"});
  EXPECT_EQ(power({{0, 1}, {}}), Places{"/polynomial/coefficients/1"});
  EXPECT_EQ(power({{0, 1}, {0, nan}}), Places{"/polynomial/coefficients/1/1"});
  EXPECT_EQ(power({{0, 1}, std::vector<double>(26, 1.0)}), Places{"/polynomial/coefficients/1"});
  EXPECT_EQ(power({{0, 1e300}, {0, 1}}), Places{"/polynomial/coefficients/0/1"});
  const auto bezier = [](std::vector<Vec> points, std::vector<double> weights) {
    return fault_places([&] { Rational::bezier(points, weights); });
  };
  EXPECT_EQ(bezier({{0, 0, 0}}, {}), Places{"/points"});
  EXPECT_EQ(bezier({{0, 0, 0}, {1, nan, 0}}, {}), Places{"/points/1"});
  EXPECT_EQ(bezier({{0, 0, 0}, {1, 0, 0}}, {1}), Places{"/weights"});
  EXPECT_EQ(bezier({{0, 0, 0}, {1, 0, 0}}, {1, 0}), Places{"/weights/1"});
  EXPECT_EQ(bezier({{0, 0, 0}, {1, 0, 0}}, {1, 1e12}), Places{"/weights"});
}

}  // namespace
}  // namespace bahnwerk
