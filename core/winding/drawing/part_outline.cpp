#include "core/winding/drawing/part_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/winding/needle/rotor_obstacles.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

/// Lines of one slot or pole in the section; x runs along its middle from the axis.
using Section = std::vector<std::vector<Point>>;

void append(std::vector<Point>& line, const Edge& edge) {
  const int pieces = edge.straight() ? 1 : std::max(1, static_cast<int>(std::ceil(std::abs(edge.turn) / 0.3)));
  if (line.empty()) line.push_back(edge.from);
  for (int i = 1; i <= pieces; ++i) line.push_back(edge.at(static_cast<double>(i) / pieces));
}

std::vector<Polyline3> repeated(const Section& section, int count, double pitch, double low, double high) {
  std::vector<Polyline3> lines;
  const auto place = [](Point p, double angle, double z) {
    const Vec3 at = turned({p.x, p.y, z}, angle);
    return Vec{at.x, at.y, at.z};
  };
  for (int n = 0; n < count; ++n)
    for (const double z : {low, high})
      for (const std::vector<Point>& line : section) {
        Polyline3 drawn;
        for (const Point p : line) drawn.push_back(place(p, n * pitch, z));
        lines.push_back(std::move(drawn));
        if (z != low) continue;
        for (const Point p : {line.front(), line.back()})
          lines.push_back({place(p, n * pitch, low), place(p, n * pitch, high)});
      }
  return lines;
}

/// Returns the outline without the circle about the axis, which the neighbours interrupt.
std::vector<Point> open_line(const Region& region, Point axis) {
  const auto edges = region.edges();
  std::size_t circle = 0;
  double longest = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (!edges[i].straight() && distance(edges[i].centre, axis) < 1e-9 && std::abs(edges[i].turn) > longest)
      longest = std::abs(edges[i].turn), circle = i;
  std::vector<Point> line;
  for (std::size_t i = 1; i < edges.size(); ++i) append(line, edges[(circle + i) % edges.size()]);
  return line;
}

/// Returns the arc about the axis from the end of one line to the beginning of the next one, `pitch` further.
std::vector<Point> between(Point from, Point to, double pitch) {
  const double begin = std::atan2(from.y, from.x), way = std::atan2(to.y, to.x) + pitch - begin,
               round = 2 * std::numbers::pi, sweep = way - round * std::floor(way / round);
  std::vector<Point> line;
  const int pieces = std::max(1, static_cast<int>(std::ceil(sweep / 0.1)));
  for (int i = 0; i <= pieces; ++i)
    line.push_back(norm(from) * Point{std::cos(begin + sweep * i / pieces), std::sin(begin + sweep * i / pieces)});
  return line;
}

}  // namespace

std::vector<Polyline3> part_outline(const StatorPart& part, const Slot& slot) {
  const double axis = part.heads.base_radius;
  std::vector<Point> line = open_line(StatorIron(part, slot).air(), {0, axis});
  // Converts from slot coordinates and orders the points from negative to positive y.
  for (Point& p : line) p = {axis - p.y, p.x};
  if (line.front().y > line.back().y) std::reverse(line.begin(), line.end());
  return repeated({line, between(line.back(), line.front(), part.pitch())}, part.slots, part.pitch(), 0,
                  part.heads.stack);
}

std::vector<Polyline3> part_outline(const RotorPart& part, const Slot& slot) {
  std::vector<Point> line = open_line(RotorIron(part, slot).iron(), {0, 0});
  if (line.front().y > line.back().y) std::reverse(line.begin(), line.end());
  return repeated({line, between(line.back(), line.front(), part.pitch())}, part.poles, part.pitch(),
                  -part.heads.cap_base, part.heads.stack + part.heads.cap_base);
}

}  // namespace bahnwerk::winding
