#include "core/drawing/spline_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/path/arc_length.hpp"
#include "core/geometry/spline/spline_arc.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

double off(const SplinePoint& p, const SplinePoint& a, const SplinePoint& b) {
  const Vec way = place(b) - place(a), from = place(p) - place(a);
  const double t = std::clamp(dot(from, way) / std::max(dot(way, way), 1e-300), 0.0, 1.0);
  return norm(from - t * way);
}

TEST(SplinePoints, ChordsStayWithinTheTolerance) {
  Random random(3);
  for (std::size_t degree = 1; degree <= 9; ++degree) {
    std::vector<HomogeneousPoint> points;
    for (std::size_t i = 0; i <= degree; ++i) {
      SplinePoint p{};
      for (std::size_t d = 0; d < p.size(); ++d) p[d] = random.uniform(-1, 1) * (d < 3 ? 50 : 1);
      points.push_back(homogeneous(p, random.uniform(0.3, 3)));
    }
    const std::vector<BezierPiece> pieces{BezierPiece(points)};
    for (const double tolerance : {1.0, 0.01}) {
      const auto line = spline_points(pieces, tolerance);
      EXPECT_EQ(line.size() > 2, degree > 1);
      for (int i = 0; i <= 400; ++i) {
        const SplinePoint p = pieces[0].at(i / 400.0)[0];
        double least = 1e300;
        for (std::size_t k = 1; k < line.size(); ++k) least = std::min(least, off(p, line[k - 1], line[k]));
        EXPECT_LT(least, 1.2 * tolerance) << degree;
      }
    }
  }
}

TEST(SplinePoints, JointsStandOnceAndGapsTwice) {
  const auto a = BezierPiece::line({0, 0, 0, 0, 0}, {1, 0, 0, 0, 0}),
             b = BezierPiece::line({1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}),
             c = BezierPiece::line({1, 1, 0, 0.5, 0}, {2, 1, 0, 0.5, 0});
  EXPECT_EQ(spline_points(std::vector{a, b}, 0.1).size(), 3u);
  EXPECT_EQ(spline_points(std::vector{a, b, c}, 0.1).size(), 5u) << "the needle jumps";
  EXPECT_TRUE(spline_points({}, 0.1).empty());
  // A needle that turns on the spot.
  const BezierPiece turn(
      {homogeneous({0, 0, 0, 0, 0}, 1), homogeneous({0, 0, 0, 2, 0}, 1), homogeneous({0, 0, 0, 2, 1}, 1)});
  EXPECT_GT(spline_points(std::vector{turn}, 0.1, 0.01).size(), 5u);
}

TEST(CurvaturePoints, ValuesOnLinesAndArcsAreExact) {
  std::vector<BezierPiece> pieces{BezierPiece::line({-7, 20, 3, 0, 0}, {0, 20, 3, 0, 0})};
  const double sweep = 2.5;
  for (const BezierPiece& arc : spline_arc({0, 20, 3, 0, 0}, {0, 0, 3}, {0, 0, -1}, sweep, {0, 0, 0, 1, 0}))
    pieces.push_back(arc);
  pieces.push_back(BezierPiece::line({0, 0, 0, 0, 0}, {0, 0, 0, 1, 0}));  // no way at all
  const auto points = curvature_points(pieces, 16);
  ASSERT_EQ(points.size(), 4u * 17);
  for (const CurvaturePoint& p : points) {
    EXPECT_NEAR(p.curvature, p.piece == 1 || p.piece == 2 ? 1 / 20.0 : 0.0, 1e-12);
    EXPECT_EQ(p.piece == 0, p.length < 7 - 1e-9 || &p == &points[16]);
  }
  EXPECT_NEAR(points.back().length, 7 + 20 * sweep, 1e-9);
  EXPECT_TRUE(curvature_points({}).empty());
}

TEST(CurvaturePoints, LengthsAreThoseOfTheCurve) {
  Random random(5);
  for (int round = 0; round < 20; ++round) {
    std::vector<HomogeneousPoint> points;
    for (int i = 0; i <= 7; ++i)
      points.push_back(
          homogeneous({10.0 * i, random.uniform(-20, 20), random.uniform(-20, 20), 0, 0}, random.uniform(0.5, 2)));
    const BezierPiece piece(points);
    const auto found = curvature_points(std::vector{piece}, 64);
    std::vector<Vec> places;
    std::vector<double> weights;
    for (const HomogeneousPoint& p : points)
      places.push_back(place(projected(p))), weights.push_back(p[spline_dimension]);
    const ArcLength exact(Rational::bezier(places, weights));
    EXPECT_NEAR(found.back().length, exact.length(), 1e-6);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](auto& a, auto& b) { return a.length < b.length; }));
  }
}

}  // namespace
}  // namespace bahnwerk
