#include "core/geometry/region/point.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(Point, LeftOfIsAQuarterTurn) {
  const Point a{3, 4};
  EXPECT_EQ(left_of(a), (Point{-4, 3}));
  EXPECT_EQ(dot(a, left_of(a)), 0);
  EXPECT_EQ(cross(a, left_of(a)), 25);
  EXPECT_EQ(left_of(left_of(a)), -a);
}

TEST(Point, UnitVectorsHaveLengthOneAndNothingPointsUp) {
  EXPECT_NEAR(norm(unit({-7, 2})), 1, 1e-15);
  EXPECT_NEAR(cross(unit({-7, 2}), Point{-7, 2}), 0, 1e-14);
  EXPECT_EQ(unit({0, 0}), (Point{0, 1}));
}

TEST(Point, DistancesAreThoseOfDifferences) {
  EXPECT_EQ(distance({1, 1}, {4, 5}), 5);
  EXPECT_EQ(square_distance({1, 1}, {4, 5}), 25);
}

}  // namespace
}  // namespace bahnwerk
