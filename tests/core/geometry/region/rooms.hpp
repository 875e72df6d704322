#pragma once
/// Rooms and brute-force checks for tests of layouts that are laid wire by wire.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "core/geometry/region/region.hpp"

namespace bahnwerk::test {

inline Region polygon(const std::vector<Point>& corners) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < corners.size(); ++i) edges.push_back(line(corners[i], corners[(i + 1) % corners.size()]));
  return Region(std::move(edges));
}

inline Region rectangle(double width, double height) {
  return polygon({{0, 0}, {width, 0}, {width, height}, {0, height}});
}

/// Whether a wire at `p` keeps its distances but for `missing`, by comparing with everything.
inline bool fits(const Region& region, double radius, const std::vector<Point>& wires, Point p, double missing) {
  for (const Point& w : wires)
    if (distance(w, p) < 2 * radius - missing) return false;
  return region.distance(p) >= radius - missing;
}

/// Least cost over a dense sample of the free places: all around every wire, all along the walls and across the region.
inline double sampled_least(const Region& region, double radius, const std::vector<Point>& wires,
                            const std::function<double(Point)>& cost) {
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](Point p) {
    if (cost(p) < least && fits(region, radius, wires, p, 0)) least = cost(p);
  };
  for (const Point& w : wires)
    for (int i = 0; i < 720; ++i) {
      const double a = i * std::numbers::pi / 360;
      consider(w + (2 * radius + 1e-12) * Point{std::cos(a), std::sin(a)});
    }
  const Region centres = region.inward(radius + 1e-9);
  for (const Edge& edge : centres.edges())
    for (int i = 0; i <= 500; ++i) consider(edge.at(i / 500.0));
  const Box& box = region.box();
  for (int i = 0; i <= 60; ++i)
    for (int k = 0; k <= 60; ++k)
      consider({box.low.x + i / 60.0 * (box.high.x - box.low.x), box.low.y + k / 60.0 * (box.high.y - box.low.y)});
  return least;
}

/// No two wires nearer than 2 r and none nearer to the wall than r, to 1e-9 mm.
inline bool valid(const Region& region, double radius, const std::vector<Point>& wires) {
  for (std::size_t i = 0; i < wires.size(); ++i) {
    if (region.distance(wires[i]) < radius - 1e-9) return false;
    for (std::size_t k = 0; k < i; ++k)
      if (distance(wires[i], wires[k]) < 2 * radius - 1e-9) return false;
  }
  return true;
}

}  // namespace bahnwerk::test
