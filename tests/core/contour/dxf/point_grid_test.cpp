#include "core/contour/dxf/cut/point_grid.hpp"

#include <gtest/gtest.h>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

TEST(PointGrid, LooksAtFewOfManyAtOnePlace) {
  PointGrid grid(0.01, 100'000);
  for (int i = 0; i < 100'000; ++i) grid.add({0, 0, 0});
  std::size_t looks = 0;
  grid.near({0.005, 0, 0}, [&](std::size_t, double) {
    ++looks;
    return true;
  });
  EXPECT_EQ(looks, PointGrid::max_looks);
}

TEST(PointGrid, FindsAllWithinTheRadius) {
  Random random(11);
  PointGrid grid(0.3, 500);
  std::vector<Vec> points;
  for (int i = 0; i < 500; ++i) {
    points.push_back({random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-0.5, 0.5)});
    grid.add(points.back());
  }
  for (int k = 0; k < 200; ++k) {
    const Vec p{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-0.5, 0.5)};
    std::size_t expected = 0, found = 0;
    for (const Vec& q : points) expected += norm(q - p) <= 0.3 ? 1 : 0;
    grid.near(p, [&](std::size_t i, double distance) {
      EXPECT_EQ(distance, norm(points[i] - p));
      ++found;
      return true;
    });
    EXPECT_EQ(found, expected);
  }
}

TEST(PointGrid, StopsWhereTheVisitorHasEnough) {
  PointGrid grid(1, 10);
  for (int i = 0; i < 10; ++i) grid.add({0.01 * i, 0, 0});
  int visits = 0;
  grid.near({0, 0, 0}, [&](std::size_t, double) { return ++visits < 3; });
  EXPECT_EQ(visits, 3);
}

TEST(PointGrid, CoordinatesBeyondAllIntegersShareACell) {
  PointGrid grid(1e-9, 2);
  grid.add({1e300, 0, 0});
  int visits = 0;
  grid.near({1e300, 0, 0}, [&](std::size_t, double) {
    ++visits;
    return true;
  });
  EXPECT_EQ(visits, 1);
}

}  // namespace
}  // namespace bahnwerk
