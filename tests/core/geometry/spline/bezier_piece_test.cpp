#include "core/geometry/spline/bezier_piece.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/core/geometry/spline/spline_support.hpp"

namespace bahnwerk {
namespace {

using testing::distance;
using testing::random_piece;

TEST(BezierPiece, LineGoesLinearlyInAllCoordinates) {  // [Herrmann (4.31)–(4.34)]
  const SplinePoint a{1, 2, 3, 0.1, -0.2}, b{5, -2, 33, 1.1, 0.4};
  const auto line = BezierPiece::line(a, b);
  EXPECT_EQ(line.degree(), 1u);
  for (const double v : {0.0, 0.25, 1.0}) {
    const auto jet = line.at(v);
    for (std::size_t d = 0; d < 5; ++d) {
      EXPECT_NEAR(jet[0][d], a[d] + v * (b[d] - a[d]), 1e-14);
      EXPECT_NEAR(jet[1][d], b[d] - a[d], 1e-14);
      EXPECT_EQ(jet[2][d], 0);
    }
  }
}

TEST(BezierPiece, DerivativesAreThoseOfDifferences) {
  Random random(1);
  for (std::size_t degree = 1; degree <= BezierPiece::max_degree; ++degree)
    for (int i = 0; i < 20; ++i) {
      const auto piece = random_piece(random, degree);
      const double v = random.uniform(0.1, 0.9), h = 2e-4;
      const auto jet = piece.at(v);
      for (std::size_t n = 1; n < spline_orders; ++n) {
        SplinePoint quotient{};
        double scale = testing::size(jet[n - 1]);
        const auto m2 = piece.at(v - 2 * h)[n - 1], m1 = piece.at(v - h)[n - 1], p1 = piece.at(v + h)[n - 1],
                   p2 = piece.at(v + 2 * h)[n - 1];
        for (std::size_t d = 0; d < 5; ++d) quotient[d] = (8 * (p1[d] - m1[d]) - (p2[d] - m2[d])) / (12 * h);
        EXPECT_LE(distance(jet[n], quotient), 1e-7 * (scale + testing::size(jet[n]))) << degree << ' ' << n;
      }
    }
}

TEST(BezierPiece, ElevationIsExact) {
  Random random(2);
  for (std::size_t degree = 1; degree < BezierPiece::max_degree; ++degree)
    for (int i = 0; i < 50; ++i) {
      const auto piece = random_piece(random, degree), raised = piece.elevated(BezierPiece::max_degree);
      EXPECT_EQ(raised.degree(), BezierPiece::max_degree);
      EXPECT_EQ(raised.points().front(), piece.points().front());
      EXPECT_EQ(raised.points().back(), piece.points().back());
      for (int j = 0; j <= 20; ++j) EXPECT_LE(distance(piece.at(j / 20.0)[0], raised.at(j / 20.0)[0]), 1e-12);
      for (int j = 0; j <= 4; ++j)
        EXPECT_LE(distance(piece.at(j / 4.0)[1], raised.at(j / 4.0)[1]),
                  1e-12 * testing::size(piece.at(j / 4.0)[1]) + 1e-10);
    }
}

TEST(BezierPiece, CommonFactorOfWeightsChangesNothing) {
  Random random(3);
  const auto piece = random_piece(random, 5), scaled = piece.scaled(3.7);
  for (int j = 0; j <= 20; ++j) EXPECT_LE(distance(piece.at(j / 20.0)[2], scaled.at(j / 20.0)[2]), 1e-9);
}

TEST(BezierPiece, RefusesWhatIsNoPiece) {
  EXPECT_THROW(BezierPiece({HomogeneousPoint{}}), std::invalid_argument);
  EXPECT_THROW(BezierPiece({homogeneous({}, 1), homogeneous({1}, 0)}), std::invalid_argument);
  EXPECT_THROW(BezierPiece(std::vector<HomogeneousPoint>(11, homogeneous({}, 1))), std::invalid_argument);
  EXPECT_THROW(BezierPiece::line({}, {1}).elevated(10), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
