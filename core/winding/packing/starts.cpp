#include "core/winding/packing/starts.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::winding {
namespace {

/// Calls `take(point)` for each lattice point in the box.
template <class Take>
void each_point(const Rows& rows, const Box& box, Take take) {
  const Point across = left_of(rows.along);
  double low_u = 1e300, high_u = -1e300, low_v = 1e300, high_v = -1e300;
  for (const Point& p : {box.low, box.high, Point{box.low.x, box.high.y}, Point{box.high.x, box.low.y}}) {
    const double u = dot(p - rows.origin, rows.along), v = dot(p - rows.origin, across);
    low_u = std::min(low_u, u);
    high_u = std::max(high_u, u);
    low_v = std::min(low_v, v);
    high_v = std::max(high_v, v);
  }
  const double slack = 1e-9 * rows.pitch;
  const auto first_row = static_cast<long>(std::ceil((low_v - slack) / rows.height));
  const auto last_row = static_cast<long>(std::floor((high_v + slack) / rows.height));
  for (long row = first_row; row <= last_row; ++row) {
    const double shift = row % 2 == 0 ? 0 : rows.pitch / 2;
    const auto first = static_cast<long>(std::ceil((low_u - shift - slack) / rows.pitch));
    const auto last = static_cast<long>(std::floor((high_u - shift + slack) / rows.pitch));
    const Point begin = rows.origin + (static_cast<double>(row) * rows.height) * across + shift * rows.along;
    for (long i = first; i <= last; ++i) take(begin + (static_cast<double>(i) * rows.pitch) * rows.along);
  }
}

/// Moves a lattice point that misses the usable area by rounding into it.
bool settle(const CentreArea& usable_area, Point& p) {
  const Point in = usable_area.way_in(p);
  if (dot(in, in) > 1e-20) return false;
  p += in;
  return true;
}

/// Returns rows whose nearest neighbours are `distance` apart although their pitch is stretched.
Rows stretched(double distance, double stretch) {
  Rows rows;
  rows.pitch = distance * stretch;
  rows.height = distance * std::sqrt(1 - 0.25 * stretch * stretch);
  return rows;
}

Rows along_side(const Side& side, double distance, double stretch, bool turned, Random& random) {
  Rows rows = stretched(distance, stretch);
  rows.along = turned ? side.inwards : side.along;
  rows.origin = side.at;
  if (!turned) {
    rows.origin += random.uniform(0, rows.pitch) * rows.along;
  } else {
    rows.origin += random.uniform(0, rows.pitch) * side.along;
  }
  return rows;
}

Rows anywhere(const Box& box, double distance, double stretch, Random& random) {
  Rows rows = stretched(distance, stretch);
  const double angle = random.uniform(0, 3.141592653589793);
  rows.along = {std::cos(angle), std::sin(angle)};
  rows.origin = box.low + Point{random.uniform(0, 2 * distance), random.uniform(0, 2 * distance)};
  return rows;
}

}  // namespace

std::vector<Point> points_of(const Rows& rows, const CentreArea& usable_area) {
  std::vector<Point> points;
  each_point(rows, usable_area.box(), [&](Point p) {
    if (settle(usable_area, p)) points.push_back(p);
  });
  return points;
}

std::vector<Side> sides(std::span<const Edge> edges, double least) {
  std::vector<Side> found;
  for (const Edge& edge : edges) {
    const double chord = distance(edge.from, edge.to);
    if (chord < least) continue;
    const Point along = unit(edge.to - edge.from);
    found.push_back({edge.from, along, left_of(along), chord});
  }
  return found;
}

std::vector<Point> random_rows(const CentreArea& usable_area, const std::vector<Side>& sides, double distance,
                               std::size_t count, Random& random) {
  const double stretch = random.chance(0.6) ? 1.0 : random.uniform(0.97, 1.06);
  const double kind = random.uniform();
  std::vector<Rows> grains;
  std::vector<Side> anchors;
  if (sides.empty() || kind < 0.2) {
    grains.push_back(anywhere(usable_area.box(), distance, stretch, random));
  } else {
    const std::size_t number = sides.size() > 1 && kind > 0.55 ? 2 : 1;
    for (std::size_t i = 0; i < number; ++i) {
      const Side& side = sides[random.below(sides.size())];
      const bool turned = number == 1 && random.chance(0.15);
      anchors.push_back(side);
      grains.push_back(along_side(side, distance, stretch, turned, random));
    }
  }
  // The border of two lattices has equal distances from both sides, with a random shift.
  const double border = random.uniform(-2, 2) * distance;
  std::vector<Point> points;
  double low = 0.9, high = 1.06;
  const auto lay = [&](double scale) {
    points.clear();
    for (std::size_t g = 0; g < grains.size(); ++g) {
      Rows rows = grains[g];
      rows.pitch *= scale;
      rows.height *= scale;
      each_point(rows, usable_area.box(), [&](Point p) {
        if (grains.size() == 2) {
          const double a = dot(p - anchors[0].at, anchors[0].inwards), b = dot(p - anchors[1].at, anchors[1].inwards);
          if ((a < b + border) != (g == 0)) return;
        }
        // Wires just outside are pushed in so that they are not lost.
        const Point in = usable_area.way_in(p);
        if (dot(in, in) < 0.01 * distance * distance) points.push_back(p + in);
      });
    }
  };
  for (int i = 0; i < 7; ++i) {
    const double scale = 0.5 * (low + high);
    lay(scale);
    if (points.size() == count) break;
    (points.size() > count ? low : high) = scale;
  }
  return points;
}

std::vector<Point> best_rows(const CentreArea& usable_area, const std::vector<Side>& sides, double distance,
                             std::size_t trials, Random& random) {
  std::vector<Point> best;
  for (std::size_t i = 0; i < trials; ++i) {
    const double stretch = i % 2 == 0 ? 1.0 : random.uniform(1, 1.4142135623730951);
    Rows rows;
    if (sides.empty() || i % 4 == 3) {
      rows = anywhere(usable_area.box(), distance, stretch, random);
    } else {
      rows = along_side(sides[(i / 4) % sides.size()], distance, stretch, false, random);
    }
    // The distance is slightly larger, so that rounding lets no neighbours overlap.
    rows.pitch *= 1 + 1e-13;
    rows.height *= 1 + 1e-13;
    std::vector<Point> points = points_of(rows, usable_area);
    if (points.size() > best.size()) best = std::move(points);
  }
  return best;
}

}  // namespace bahnwerk::winding
