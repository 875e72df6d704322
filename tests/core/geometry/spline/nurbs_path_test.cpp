#include "core/geometry/spline/nurbs_path.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/core/geometry/spline/spline_support.hpp"

namespace bahnwerk {
namespace {

/// Random pieces of random degrees, end to end.
std::vector<BezierPiece> random_chain(Random& random, std::size_t count) {
  std::vector<BezierPiece> pieces;
  for (std::size_t i = 0; i < count; ++i) {
    auto points = testing::random_piece(random, 1 + random.below(7)).points();
    if (i > 0) points.front() = homogeneous(projected(pieces.back().points().back()), points.front()[5]);
    pieces.emplace_back(std::move(points));
  }
  return pieces;
}

TEST(NurbsPath, UnionEqualsThePieces) {  // [Herrmann (4.63)] against (4.62)
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const auto pieces = random_chain(random, 1 + random.below(12));
    const auto path = united(pieces);
    EXPECT_EQ(path.knots.size(), path.points.size() + path.degree + 1);
    EXPECT_EQ(path.begin(), 0);
    EXPECT_EQ(path.end(), static_cast<double>(pieces.size()));
    for (std::size_t n = 0; n < pieces.size(); ++n)
      for (int j = 0; j < 16; ++j) {
        const double v = j / 16.0;
        const auto a = path.at(static_cast<double>(n) + v), b = pieces[n].at(v);
        EXPECT_LE(testing::distance(a[0], b[0]), 1e-12 * 200);
        for (std::size_t o = 1; o < spline_orders; ++o)
          EXPECT_LE(testing::distance(a[o], b[o]), 1e-10 * (testing::size(b[o]) + 1e3)) << o;
      }
    EXPECT_LE(testing::distance(path.at(path.end())[0], pieces.back().at(1)[0]), 1e-12 * 200);
  }
}

TEST(NurbsPath, PiecesOfTheUnionAreThePieces) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const auto pieces = random_chain(random, 1 + random.below(5));
    const auto again = united(pieces).pieces();
    ASSERT_EQ(again.size(), pieces.size());
    for (std::size_t n = 0; n < pieces.size(); ++n)
      for (int j = 0; j <= 8; ++j)
        EXPECT_LE(testing::distance(again[n].at(j / 8.0)[0], pieces[n].at(j / 8.0)[0]), 1e-12 * 200);
  }
}

TEST(NurbsPath, PiecesOfASplineWithSimpleKnots) {
  Random random(3);
  for (std::size_t degree = 1; degree <= 9; ++degree) {
    NurbsPath path{degree, {}, {}};
    path.knots.assign(degree + 1, 0.0);
    for (const double u : {0.2, 0.5, 0.5, 0.9})
      if (u != 0.5 || degree > 1 || path.knots.back() != 0.5) path.knots.push_back(u);
    path.knots.insert(path.knots.end(), degree + 1, 1.0);
    for (std::size_t i = 0; i + degree + 1 < path.knots.size(); ++i)
      path.points.push_back(homogeneous(testing::random_pose(random), random.uniform(0.5, 2)));
    const auto pieces = path.pieces();
    const double borders[] = {0, 0.2, 0.5, 0.9, 1};
    ASSERT_EQ(pieces.size(), 4u);
    for (std::size_t n = 0; n < 4; ++n)
      for (int j = 0; j <= 8; ++j) {
        const double v = j / 8.0, u = borders[n] + v * (borders[n + 1] - borders[n]);
        EXPECT_LE(testing::distance(path.at(u)[0], pieces[n].at(v)[0]), 1e-11) << degree << ' ' << n;
      }
  }
}

TEST(NurbsPath, RefusesGapsAndNothing) {
  EXPECT_THROW(united({}), std::invalid_argument);
  const std::vector<BezierPiece> torn{BezierPiece::line({}, {1}), BezierPiece::line({1, 1e-6}, {2})};
  EXPECT_THROW(united(torn), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
