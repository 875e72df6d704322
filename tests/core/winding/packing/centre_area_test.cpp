#include "core/winding/packing/centre_area.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/numeric/random.hpp"
#include "tests/core/winding/packing_rooms.hpp"

namespace bahnwerk::winding {
namespace {

using namespace test;

TEST(CentreArea, AgreesWithTheExactRegion) {
  Random random(7);
  const Region usable_areas[] = {stator_room(), circle(), polygon({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}),
                                 gon(60)};
  for (const Region& usable_area : usable_areas) {
    const double radius = 0.2;
    const CentreArea centres(usable_area, radius, silent);
    const Box& b = usable_area.box();
    int inside = 0;
    for (int i = 0; i < 4000; ++i) {
      const Point p{random.uniform(b.low.x, b.high.x), random.uniform(b.low.y, b.high.y)};
      const double depth = usable_area.distance(p) - radius;
      const Point in = centres.way_in(p);
      if (depth > 1e-9) {
        EXPECT_EQ(in, Point{}) << p.x << ' ' << p.y;
      }
      if (depth < -1e-9) {
        EXPECT_GE(norm(in), -depth - 1e-9);
        EXPECT_NEAR(usable_area.distance(p + in), radius, 1e-9);
        EXPECT_NEAR(norm(in), std::abs(centres.region().distance(p)), 1e-9);
      }
      inside += depth > 0;
    }
    EXPECT_GT(inside, 500);
    for (const Point& p : centres.spread(0.1)) EXPECT_GE(usable_area.distance(p), radius - 1e-9);
  }
}

}  // namespace
}  // namespace bahnwerk::winding
