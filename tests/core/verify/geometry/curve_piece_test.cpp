#include "core/verify/geometry/curve_piece.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"

namespace bahnwerk::verify {
namespace {

TEST(CurvePiece, ALineIsOnePiece) {
  Path path;
  path.append(std::make_shared<Line>(Vec{1, 2, 0}, Vec{4, 6, 0}), 0);
  std::vector<CurvePiece> pieces;
  add_curve_pieces(path[0], 7, pieces);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].segment, 7u);
  EXPECT_EQ(pieces[0].p0, (Vec{1, 2, 0}));
  EXPECT_EQ(pieces[0].p1, (Vec{4, 6, 0}));
  EXPECT_NEAR(pieces[0].length, 5, 1e-12);
}

TEST(CurvePiece, NoPieceOfACircleTurnsByMoreThanHalfARadian) {
  Path path;
  path.append(std::make_shared<Arc>(Arc::through({5, 0, 0}, {-5, 0, 0}, {0, 0, 0}, {0, 0, 1}, true)), 0);
  std::vector<CurvePiece> pieces;
  add_curve_pieces(path[0], 0, pieces);
  EXPECT_GE(pieces.size(), static_cast<std::size_t>(std::ceil(std::numbers::pi / 0.5)));
  EXPECT_LE(pieces.size(), 16u);
  double length = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    length += pieces[i].length;
    EXPECT_LE(pieces[i].length / 5, 0.5 + 1e-9);
    if (i > 0) {
      EXPECT_EQ(pieces[i].u0, pieces[i - 1].u1);
      EXPECT_EQ(pieces[i].p0, pieces[i - 1].p1);
    }
  }
  EXPECT_NEAR(length, 5 * std::numbers::pi, 1e-9);
}

}  // namespace
}  // namespace bahnwerk::verify
