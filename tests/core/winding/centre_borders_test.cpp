#include "core/winding/centre_borders.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"
#include "tests/core/winding/packing_rooms.hpp"

namespace bahnwerk::winding {
namespace {

using namespace test;

double total(const CentreBorders& borders) {
  double length = 0;
  for (const Edge& piece : borders.pieces) length += piece.length();
  return length;
}

TEST(CentreBorders, InAWideRectangleTheyAreTheSmallerRectangle) {
  EXPECT_NEAR(total(centre_borders(rectangle(7, 3), 0.5)), 2 * (6 + 2), 1e-9);
  EXPECT_NEAR(total(centre_borders(circle(), 0.25)), 2 * std::numbers::pi * 0.75, 1e-9);
}

TEST(CentreBorders, AnExactFitIsALineFromEitherWall) {
  EXPECT_NEAR(total(centre_borders(rectangle(7, 1), 0.5)), 2 * 6, 1e-9);
  EXPECT_TRUE(centre_borders(rectangle(7, 0.99), 0.5).pieces.empty()) << "too narrow";
}

TEST(CentreBorders, EveryPieceKeepsTheRadiusFromTheWalls) {
  for (const Region& area : {stator_room(), triangle(), gon(12)}) {
    const double radius = 0.1;
    const CentreBorders borders = centre_borders(area, radius);
    ASSERT_FALSE(borders.pieces.empty());
    for (const Edge& piece : borders.pieces)
      for (const double f : {0.0, 0.3, 0.5, 1.0}) EXPECT_NEAR(area.distance(piece.at(f)), radius, 1e-8);
  }
}

}  // namespace
}  // namespace bahnwerk::winding
