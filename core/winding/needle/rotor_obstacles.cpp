#include "core/winding/needle/rotor_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/base/errors.hpp"
#include "core/geometry/region/crossings.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

void check(const RotorShape& shape) {
  std::vector<InputFault> faults;
  const auto check = [&](const char* member, double value) {
    if (!(value >= 0) || !std::isfinite(value)) faults.push_back({{"rotor", member}, "is not a number of 0 or more"});
  };
  check("shoe_edge", shape.shoe_edge);
  check("outer_wall", shape.outer_wall);
  check("wall_overhang", shape.wall_overhang);
  if (!faults.empty()) throw InvalidInput(faults);
}

/// Returns the edge that closes the slot: the one that runs back above the base.
std::size_t closing_edge(const Region& slot) {
  const auto edges = slot.edges();
  std::size_t closing = edges.size();
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges[i].straight() && (closing == edges.size() || edges[i].direction(0).x < edges[closing].direction(0).x))
      closing = i;
  if (closing == edges.size()) throw std::invalid_argument("the slot has no straight line that closes it");
  return closing;
}

/// Returns the side from the root's flank along the pole to the shoe's flank, moved by `origin`.
std::vector<Edge> side_of(const Slot& slot, Point origin) {
  const std::size_t closing = closing_edge(slot.iron);
  const auto edges = slot.iron.edges();
  std::vector<Edge> side;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    Edge e = edges[(closing + i) % edges.size()];
    e.from += origin, e.to += origin, e.centre += origin;
    side.push_back(e);
  }
  if (side.size() < 2 || !side.front().straight() || !side.back().straight())
    throw std::invalid_argument("a rotor slot ends in straight flanks");
  return side;
}

Edge mirrored(Edge e) {
  e.from.y = -e.from.y, e.to.y = -e.to.y, e.centre.y = -e.centre.y, e.turn = -e.turn;
  return e;
}

Region pole_of(const RotorPart& part, const Slot& slot, double shoe_edge) {
  std::vector<Edge> side = side_of(slot, {part.heads.tooth_radius, part.heads.tooth_half_width});
  const Point axis{0, 0}, root = side.front().from, tip = side.back().to;
  if (shoe_edge > 0) side.push_back(line(tip, tip + shoe_edge * unit(tip)));
  const Point edge = side.back().to;
  // The outline is reversed, because the iron has to lie on its left.
  std::vector<Edge> loop{arc_between(axis, {edge.x, -edge.y}, edge, true)};
  for (std::size_t i = side.size(); i-- > 0;) loop.push_back(side[i].reversed());
  loop.push_back(arc_between(axis, root, {root.x, -root.y}, true));
  for (const Edge& e : side) loop.push_back(mirrored(e));
  if (self_contact(loop))
    throw InvalidInput({{{"slot", "root_flank"}, "reaches into the rotor's hub or the pole's outer circle"}});
  return Region(std::move(loop));
}

/// Returns the place of the line through a flank at a height above the grooves.
double flank_at(const Edge& flank, double height) {
  return flank.from.x + (height - flank.from.y) / (flank.to.y - flank.from.y) * (flank.to.x - flank.from.x);
}

/// Returns a convex section above the grooves at the stack's upper end, or its mirror image at the lower end.
Region section(std::vector<Point> corners, double grooves, bool top, double stack) {
  for (Point& p : corners) p.y = top ? stack + grooves + p.y : -grooves - p.y;
  if (!top) std::reverse(corners.begin(), corners.end());
  std::vector<Edge> loop;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point next = corners[(i + 1) % corners.size()];
    if (square_distance(corners[i], next) > 1e-18) loop.push_back(line(corners[i], next));
  }
  return Region(std::move(loop));
}

}  // namespace

RotorIron::RotorIron(const RotorPart& part, const Slot& slot, const RotorShape& shape)
    : pitch_(part.pitch()), low_(-part.heads.cap_base), high_(part.heads.stack + part.heads.cap_base) {
  check(shape);
  iron_ = pole_of(part, slot, shape.shoe_edge);
}

double RotorIron::section_distance(Vec3 p) const {
  const double from_axis = std::hypot(p.x, p.y), local = std::remainder(azimuth(p), pitch_);
  return -iron_.distance({from_axis * std::cos(local), from_axis * std::sin(local)});
}

double RotorIron::section_distance(Vec3 p, double slot) const {
  const double half = pitch_ / 2, from_axis = std::hypot(p.x, p.y),
               local = std::clamp(std::remainder(azimuth(p) - slot, 2 * std::numbers::pi), -half, half),
               from_pole = half - std::abs(local);
  return -iron_.distance({from_axis * std::cos(from_pole), from_axis * std::sin(from_pole)});
}

Solid RotorIron::solid(double tolerance) const {
  std::vector<Point> line;
  for (const Edge& edge : open_edges(iron_, {0, 0})) {
    if (line.empty()) line.push_back(edge.from);
    append_chords(edge, tolerance, line);
  }
  Solid solid;
  solid.outline = closed_round(line, static_cast<int>(std::lround(2 * std::numbers::pi / pitch_)), pitch_, tolerance);
  solid.from = low_, solid.to = high_;
  return solid;
}

Wall::Wall(double azimuth, Region section, double half_width)
    : outwards_(azimuth), inwards_(-azimuth), half_width_(half_width), section_(std::move(section)) {}

double Wall::distance(Vec3 p) const {
  const Vec3 local = turned(p, inwards_);
  const double section = -section_.distance({local.x, local.z}), beyond = std::abs(local.y) - half_width_;
  if (section <= 0 || beyond <= 0) return std::max(section, beyond);
  return std::hypot(section, beyond);
}

Vec3 Wall::away(Vec3 p) const {
  const Vec3 local = turned(p, inwards_);
  const Point at{local.x, local.z};
  const Region::Nearest nearest = section_.nearest(at);
  const double section = -nearest.distance, beyond = std::abs(local.y) - half_width_;
  const Point out = section > 1e-9 ? (1 / section) * (at - nearest.at) : -nearest.normal;
  double radial_share = section, across_share = beyond;
  if (section <= 0 || beyond <= 0) {
    radial_share = section >= beyond ? 1 : 0;
    across_share = 1 - radial_share;
  }
  const Vec3 n{radial_share * out.x, std::copysign(across_share, local.y), radial_share * out.y};
  return turned((1 / norm(n)) * n, outwards_);
}

Solid Wall::solid(double tolerance) const {
  Solid solid;
  solid.x = turned(solid.x, outwards_), solid.y = {0, 0, 1}, solid.z = cross(solid.x, solid.y);
  for (const Edge& edge : section_.edges()) append_chords(edge, tolerance, solid.outline);
  solid.from = -half_width_, solid.to = half_width_;
  return solid;
}

std::vector<Wall> cap_walls(const RotorPart& part, const Slot& slot, const RotorShape& shape) {
  check(shape);
  const RotorHeads& h = part.heads;
  const double height = h.cap_height - h.cap_base, half = h.tooth_half_width + shape.wall_overhang;
  if (shape.outer_wall > height)
    throw InvalidInput({{{"rotor", "outer_wall"}, "is higher than the end cap above its grooves"}});
  const std::vector<Edge> side = side_of(slot, {h.tooth_radius, 0});
  const Edge &root = side.front(), &shoe = side.back();
  // Coordinates are radius and height above the grooves.
  const double foot = flank_at(root, 0), top = flank_at(root, height);
  std::vector<Point> inner{{foot, 0}, {std::max(top, 0.0), height}, {0, height}, {0, 0}};
  if (top < 0) inner = {{foot, 0}, {0, foot / (foot - top) * height}, {0, 0}};
  const double tip = std::hypot(shoe.to.x, shoe.to.y + h.tooth_half_width) + shape.shoe_edge,
               at_top = flank_at(shoe, shape.outer_wall), outer = std::max(tip, at_top);
  const std::vector<Point> beyond{
      {flank_at(shoe, 0), 0}, {outer, 0}, {outer, shape.outer_wall}, {at_top, shape.outer_wall}};
  std::vector<Wall> walls;
  for (int pole = 0; pole < part.poles; ++pole)
    for (const bool upper : {false, true}) {
      const double azimuth = pole * part.pitch();
      walls.emplace_back(azimuth, section(inner, h.cap_base, upper, h.stack), half + root.from.y);
      if (shape.outer_wall > 0)
        walls.emplace_back(azimuth, section(beyond, h.cap_base, upper, h.stack), half + shoe.to.y);
    }
  return walls;
}

}  // namespace bahnwerk::winding
