#include "core/verify/cam/polyline_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"

namespace bahnwerk::verify {
namespace {

std::vector<Point> circle(double radius, int parts, Point centre = {}) {
  std::vector<Point> out;
  for (int k = 0; k <= parts; ++k) {
    const double angle = 2 * std::numbers::pi * k / parts;
    out.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return out;
}

TEST(PolylineDistance, OfConcentricCirclesIsTheDifferenceOfTheirRadii) {
  Progress silent;
  EXPECT_NEAR(nearest_approach(circle(50, 2000), circle(40, 2000), 10, silent).distance, 10, 1e-3);
}

TEST(PolylineDistance, OfCrossingLinesIsZero) {
  Progress silent;
  EXPECT_EQ(nearest_approach({{0, -1}, {0, 1}}, {{-1, 0.2}, {1, 0.2}}, 10, silent).distance, 0);
}

TEST(PolylineDistance, FindsTheNearestChordAmongFarOnes) {
  Progress silent;
  const NearestApproach found = nearest_approach(circle(5, 400, {100, 0}), circle(40, 4000), 60, silent);
  EXPECT_NEAR(found.distance, 55, 1e-2);
  EXPECT_NEAR(static_cast<double>(found.index), 200, 2);
}

}  // namespace
}  // namespace bahnwerk::verify
