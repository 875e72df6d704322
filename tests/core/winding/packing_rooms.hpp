#pragma once
/// Rooms in which packings are searched, and whether what is found is allowed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/progress.hpp"
#include "tests/core/geometry/region/rooms.hpp"

namespace bahnwerk::winding::test {

using namespace bahnwerk::test;

inline Region square() { return polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}); }
inline Region triangle() { return polygon({{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}); }
inline Region circle() { return Region({arc({0, 0}, 1, 0, 2 * std::numbers::pi)}); }
/// Circumscribes the unit circle.
inline Region gon(int sides) {
  std::vector<Point> corners;
  const double radius = 1 / std::cos(std::numbers::pi / sides);
  for (int i = 0; i < sides; ++i)
    corners.push_back(
        {radius * std::cos(2 * std::numbers::pi * i / sides), radius * std::sin(2 * std::numbers::pi * i / sides)});
  return polygon(corners);
}
/// The stator slot of [Herrmann Table 4.1] without its small roundings, with liner and wedge.
inline Region stator_room() {
  const double y = 95.48 - std::sqrt(95.48 * 95.48 - 2.9285 * 2.9285);
  const Point a{-2.9285, y}, b{2.9285, y}, c{2.22625, 16.129}, d{-2.22625, 16.129};
  const Region iron({arc_between({0, 95.48}, a, b, true), line(b, c), line(c, d), line(d, a)});
  return iron.inward(0.22).without(
      polygon({{-1.8415, 16.129 - 0.42}, {1.8415, 16.129 - 0.42}, {1.8415, 17}, {-1.8415, 17}}));
}

/// Distance from the boundary by walking along every edge: knows nothing of nearest(). Too large by at most
/// (edge length / 20000)² / 8 / distance.
inline double walked_distance(const Region& usable_area, Point p) {
  double least = 1e300;
  for (const Edge& edge : usable_area.edges())
    for (int i = 0; i <= 20000; ++i) least = std::min(least, distance(p, edge.at(i / 20000.0)));
  return least;
}
/// Winding number by the angles that a fine walk along the boundary turns through.
inline bool walked_inside(const Region& usable_area, Point p) {
  double turned = 0;
  for (const Edge& edge : usable_area.edges()) {
    Point last = edge.from - p;
    for (int i = 1; i <= 256; ++i) {
      const Point next = edge.at(i / 256.0) - p;
      turned += std::atan2(cross(last, next), dot(last, next));
      last = next;
    }
  }
  return turned > std::numbers::pi;
}
inline void expect_allowed(const Region& usable_area, double radius, double overlap, const std::vector<Point>& wires) {
  for (std::size_t i = 0; i < wires.size(); ++i) {
    EXPECT_TRUE(walked_inside(usable_area, wires[i])) << i;
    EXPECT_GE(walked_distance(usable_area, wires[i]), radius - 1e-9) << i;
    for (std::size_t k = 0; k < i; ++k) EXPECT_GE(distance(wires[i], wires[k]), 2 * radius - overlap - 1e-9) << i << k;
  }
}

inline Progress silent;

}  // namespace bahnwerk::winding::test
