#include "core/geometry/path/turned.hpp"

#include <gtest/gtest.h>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {
namespace {

Path sample() {
  Path path;
  path.append(std::make_shared<Line>(Vec{0, 0, 0}, Vec{10, 0, 2}), 3);
  path.append(std::make_shared<Arc>(Arc::through({10, 0, 2}, {20, 10, 5}, {10, 10, 2}, {0, 0, 1}, true)), 4);
  path.append(std::make_shared<Rational>(
                  Rational::bezier({{20, 10, 5}, {25, 20, 5}, {40, 30, 7}, {50, 20, 9}}, {1, 2, 0.5, 1})),
              5);
  path.append(std::make_shared<Rational>(Rational::from_power_basis({{50, 3, 4}, {20, -5, 1, 2}, {9, 0, 1}})), 6);
  return path;
}

TEST(Turned, PointsAndDerivativesAreTheImagesAndLengthsStay) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (const double sign : {1.0, -1.0}) {  // a rotation and a reflection
    const Isometry map{{Vec{c, s, 0}, Vec{-s * sign, c * sign, 0}, Vec{0, 0, 1}}, {5, -3, 11}};
    const Path given = sample(), image = turned(given, map);
    ASSERT_EQ(image.size(), given.size());
    EXPECT_NEAR(image.length(), given.length(), 1e-12);
    for (std::size_t i = 0; i < given.size(); ++i) {
      EXPECT_EQ(image[i].source(), given[i].source());
      for (const double x : {0.0, 0.3, 1.0}) {
        const double u = given[i].curve().begin() + x * (given[i].curve().end() - given[i].curve().begin());
        const PathPoint a = given[i].at_parameter(u), b = image[i].at_parameter(u);
        EXPECT_LE(norm(b.value - map(a.value)), 1e-12);
        EXPECT_LE(norm(b.d1 - map.turned(a.d1)), 1e-13);
        EXPECT_LE(norm(b.d2 - map.turned(a.d2)), 1e-12);
        EXPECT_LE(norm(b.d3 - map.turned(a.d3)), 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace bahnwerk
