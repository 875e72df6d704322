#include "core/geometry/region/region.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/geometry/region/random_region.hpp"
#include "tests/core/geometry/region/rooms.hpp"

namespace bahnwerk {
namespace {

using std::numbers::pi;

using test::polygon;
using test::rectangle;

Region disc(double radius) { return Region({arc({0, 0}, radius, 0, 2 * pi)}); }
/// Two squares of 4 mm joined by a neck of 1 mm width and 2 mm length.
Region dumbbell() {
  return polygon(
      {{0, 0}, {4, 0}, {4, 1.5}, {6, 1.5}, {6, 0}, {10, 0}, {10, 4}, {6, 4}, {6, 2.5}, {4, 2.5}, {4, 4}, {0, 4}});
}

TEST(Region, KnowsAreasAndLengths) {
  EXPECT_NEAR(rectangle(3, 2).area(), 6, 1e-14);
  EXPECT_NEAR(rectangle(3, 2).length(), 10, 1e-14);
  EXPECT_NEAR(disc(2).area(), 4 * pi, 1e-13);
  EXPECT_NEAR(disc(2).length(), 4 * pi, 1e-13);
  EXPECT_NEAR(dumbbell().area(), 34, 1e-13);
}

TEST(Region, DistanceIsSignedAndTakesTheCornersSide) {
  const Region region = rectangle(3, 2);
  EXPECT_NEAR(region.distance({1.5, 0.4}), 0.4, 1e-15);
  EXPECT_NEAR(region.distance({-3, -4}), -5, 1e-15);
  EXPECT_NEAR(region.distance({1, 2.5}), -0.5, 1e-15);
  EXPECT_NEAR(disc(2).distance({0.5, 0}), 1.5, 1e-15);
  EXPECT_NEAR(disc(2).distance({0, -3}), -1, 1e-15);
  const Region bell = dumbbell();
  const Region::Nearest corner = bell.nearest({3.9, 1.4});  // the neck's corner juts into the region at (4, 1.5)
  EXPECT_NEAR(corner.distance, 0.1, 1e-14);                 // the wall at x = 4 is as near as the corner is not
  EXPECT_NEAR(bell.nearest({3.7, 1.9}).distance, std::hypot(0.3, 0.4), 1e-14);
  EXPECT_NEAR(bell.nearest({3.7, 1.9}).normal.x, -0.6, 1e-14);
  EXPECT_NEAR(bell.nearest({3.7, 1.9}).normal.y, 0.8, 1e-14);
}

TEST(Region, DistanceEqualsABruteForceOne) {
  Random random(11);
  for (int k = 0; k < 60; ++k) {
    const Region region = test::random_region(random);
    const auto polygon = test::sampled(region, 2e-3);
    for (int i = 0; i < 60; ++i) {
      const Point p{random.uniform(-7, 7), random.uniform(-7, 7)};
      EXPECT_NEAR(region.distance(p), test::slow_distance(polygon, p), 2e-3) << p.x << ' ' << p.y;
      const Region::Nearest n = region.nearest(p);
      EXPECT_NEAR(norm(n.normal), 1, 1e-12);
      EXPECT_NEAR(distance(n.at + n.distance * n.normal, p), 0, 1e-9);
    }
  }
}

TEST(Region, InwardOfARectangleAndADisc) {
  const Region small = rectangle(3, 2).inward(0.5);
  EXPECT_NEAR(small.area(), 2, 1e-9);
  EXPECT_EQ(small.edges().size(), 4u);
  EXPECT_NEAR(disc(2).inward(0.5).area(), 2.25 * pi, 1e-9);
  EXPECT_TRUE(rectangle(3, 2).inward(1.01).empty());
  EXPECT_TRUE(disc(2).inward(2.01).empty());
}

TEST(Region, OutwardRoundsCorners) {
  EXPECT_NEAR(rectangle(3, 2).inward(-0.5).area(), 6 + 10 * 0.5 + pi / 4, 1e-9);  // Steiner
  EXPECT_NEAR(disc(2).inward(-0.5).area(), 6.25 * pi, 1e-9);
}

TEST(Region, InwardFallsApartAtANeck) {
  const Region two = dumbbell().inward(0.6);
  // Two squares, each with what lies in the neck's mouth farther than 0.6 mm from its corners.
  const double mouth = 2 * (0.3 - (0.25 * std::sqrt(0.11) + 0.18 * std::asin(5.0 / 6)));
  EXPECT_NEAR(two.area(), 2 * (2.8 * 2.8 + mouth), 1e-9);
  std::size_t loops = 0;
  for (std::size_t i = 0; i < two.edges().size(); ++i) loops += two.begins_loop(i);
  EXPECT_EQ(loops, 2u);
  const Region one = dumbbell().inward(0.4);
  loops = 0;
  for (std::size_t i = 0; i < one.edges().size(); ++i) loops += one.begins_loop(i);
  EXPECT_EQ(loops, 1u);
}

TEST(Region, InwardHoldsWhatIsDeepEnough) {
  Random random(12);
  for (int k = 0; k < 60; ++k) {
    const Region region = test::random_region(random);
    const double depth = random.uniform(-0.5, 1.5);
    const Region inner = region.inward(depth);
    for (const Edge& edge : inner.edges())
      for (const double f : {0.0, 0.3, 0.7}) EXPECT_NEAR(region.distance(edge.at(f)), depth, 1e-7);
    for (int i = 0; i < 100; ++i) {
      const Point p{random.uniform(-7, 7), random.uniform(-7, 7)};
      const double deep = region.distance(p) - depth;
      if (std::abs(deep) < 1e-6) continue;
      EXPECT_EQ(!inner.empty() && inner.distance(p) > 0, deep > 0) << depth << ' ' << p.x << ' ' << p.y;
    }
  }
}

TEST(Region, WithoutRemovesTheOtherRegion) {
  const Region piece =
      Region({line({1, 1.5}, {2, 1.5}), line({2, 1.5}, {2, 3}), line({2, 3}, {1, 3}), line({1, 3}, {1, 1.5})});
  const Region rest = rectangle(3, 2).without(piece);
  EXPECT_NEAR(rest.area(), 5.5, 1e-12);
  EXPECT_EQ(rest.edges().size(), 8u);
  EXPECT_NEAR(rest.distance({1.5, 1.2}), 0.3, 1e-12);
  EXPECT_LT(rest.distance({1.5, 1.8}), 0);
  EXPECT_NEAR(rectangle(3, 2).without(disc(0.5).inward(0.1)).area(), 6 - 0.04 * pi, 1e-12);  // a corner's quarter
}

TEST(Region, RefusesALoopThatDoesNotClose) {
  EXPECT_THROW(Region({line({0, 0}, {1, 0}), line({1, 0}, {1, 1})}), std::invalid_argument);
}

// Fine outlines have corners so shallow that parallels hardly part there.
TEST(Region, InwardOfAFineOutline) {
  for (const double wave : {0.0, 0.002, 0.02})
    for (const int corners : {50, 200, 500, 1000, 2000})
      for (const double depth : {0.05, 0.2, 0.5}) {
        std::vector<Point> points;
        for (int i = 0; i < corners; ++i) {
          const double a = 2 * std::numbers::pi * i / corners;
          points.push_back(40 * (1 + wave * std::sin(37 * a)) * Point{std::cos(a), std::sin(a)});
        }
        const Region outline = polygon(points), inner = outline.inward(depth);
        // Steiner: A - depth P + depth² π, where nothing closes.
        const double area = outline.area() - depth * outline.length() + depth * depth * std::numbers::pi;
        EXPECT_NEAR(inner.area(), area, 0.02 * depth * outline.length()) << wave << ", " << corners << ", " << depth;
      }
}

}  // namespace
}  // namespace bahnwerk
