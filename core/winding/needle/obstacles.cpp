#include "core/winding/needle/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/base/errors.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

/// Returns a drawn slot's outline with the bore in place of its mouth, from one end of the opening to the other.
Region drawn_air(const StatorPart& part, const Slot& slot) {
  const Opening& opening = *slot.opening;
  const double half = opening.clear / 2, axis = part.heads.base_radius;
  const Point right = opening.middle + Point{half, 0}, left = opening.middle - Point{half, 0};
  if (opening.middle.y >= axis)
    throw InvalidInput({{{"part", "base_radius"}, "leaves no bore inside the slot's opening"}});
  // Returns the outline from the left end round the base to the right end.
  const auto edges = slot.iron.edges();
  const auto nearest = [&](Point p) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < edges.size(); ++i)
      if (distance(edges[i].at(edges[i].nearest(p)), p) < distance(edges[best].at(edges[best].nearest(p)), p)) best = i;
    return best;
  };
  const std::size_t first = nearest(left), last = nearest(right);
  std::vector<Edge> loop;
  const auto append = [&](const Edge& e) {
    if (e.length() > 1e-9) loop.push_back(e);
  };
  // If both ends of the opening are on one edge, all of the outline lies between them.
  append(edges[first].part(edges[first].nearest(left), 1));
  std::size_t i = first;
  do {
    i = (i + 1) % edges.size();
    append(i == last ? edges[i].part(0, edges[i].nearest(right)) : edges[i]);
  } while (i != last);
  if (loop.empty()) throw InvalidInput({{{"slot", "opening"}, "leaves nothing of the slot's outline"}});
  if (loop.front().straight()) loop.front().from = left;
  if (loop.back().straight()) loop.back().to = right;
  loop.push_back(arc_between({0, axis}, right, left, true));
  return Region(std::move(loop));
}

/// Returns the slot's outline with the line between the tooth tips replaced by tips, opening and bore.
Region air_of(const StatorPart& part, const Slot& slot) {
  if (part.drawn) return drawn_air(part, slot);
  const double h = part.slot.height, r = part.slot.tip_corner_radius, axis = part.heads.base_radius;
  std::vector<Edge> loop;
  bool opened = false;
  for (const Edge& e : slot.iron.edges()) {
    const bool closing = !opened && e.straight() && std::abs(e.from.y - h) < 1e-9 && std::abs(e.to.y - h) < 1e-9;
    if (!closing) {
      loop.push_back(e);
      continue;
    }
    opened = true;
    const double x = std::min(part.slot.opening_width / 2, e.from.x);
    const Point right{x, h}, left{-x, h}, out_right{x, h + 2 * r}, out_left{-x, h + 2 * r}, middle{0, axis};
    const double quarter = std::numbers::pi / 2;
    if (distance(e.from, right) > 1e-12) loop.push_back(line(e.from, right));
    if (r > 0) loop.push_back(arc({x, h + r}, r, -quarter, -2 * quarter));
    loop.push_back(arc_between(middle, out_right, out_left, true));
    if (r > 0) loop.push_back(arc({-x, h + r}, r, quarter, -2 * quarter));
    if (distance(left, e.to) > 1e-12) loop.push_back(line(left, e.to));
  }
  if (!opened) throw std::invalid_argument("the slot has no straight line between its tooth tips");
  if (h + 2 * r >= axis) throw InvalidInput({{{"part", "base_radius"}, "leaves no bore inside the tooth tips"}});
  return Region(std::move(loop));
}

}  // namespace

StatorIron::StatorIron(const StatorPart& part, const Slot& slot)
    : air_(air_of(part, slot)), axis_(part.heads.base_radius), pitch_(part.pitch()), stack_(part.heads.stack) {}

double StatorIron::local_distance(double from_axis, double angle) const {
  return air_.distance({from_axis * std::sin(angle), axis_ - from_axis * std::cos(angle)});
}

double StatorIron::section_distance(Vec3 p) const {
  return local_distance(std::hypot(p.x, p.y), std::remainder(azimuth(p), pitch_));
}

double StatorIron::section_distance(Vec3 p, double slot) const {
  const double local = std::remainder(azimuth(p) - slot, 2 * std::numbers::pi);
  return local_distance(std::hypot(p.x, p.y), std::clamp(local, -pitch_ / 2, pitch_ / 2));
}

Solid StatorIron::solid(double tolerance) const {
  std::vector<Point> line;
  for (const Edge& edge : open_edges(air_, {0, axis_})) {
    if (line.empty()) line.push_back(edge.from);
    append_chords(edge, tolerance, line);
  }
  // Converts from slot coordinates: slot 0 has its middle on the x axis.
  for (Point& p : line) p = {axis_ - p.y, p.x};
  const auto slots = static_cast<int>(std::lround(2 * std::numbers::pi / pitch_));
  std::vector<Point> round = closed_round(line, slots, pitch_, tolerance);
  std::reverse(round.begin(), round.end());
  Solid solid;
  solid.holes.push_back(std::move(round));
  solid.to = stack_;
  return solid;
}

Block::Block(double azimuth, const Extent& extent)
    : outwards_(azimuth),
      inwards_(-azimuth),
      middle_{(extent.inner + extent.outer) / 2, (extent.left + extent.right) / 2, (extent.low + extent.high) / 2},
      half_{(extent.outer - extent.inner) / 2, (extent.right - extent.left) / 2, (extent.high - extent.low) / 2} {}

double Block::distance(Vec3 p) const {
  const Vec3 d = turned(p, inwards_) - middle_;
  const Vec3 out{std::abs(d.x) - half_.x, std::abs(d.y) - half_.y, std::abs(d.z) - half_.z};
  const double inside = std::max({out.x, out.y, out.z});
  if (inside <= 0) return inside;
  return norm({std::max(out.x, 0.0), std::max(out.y, 0.0), std::max(out.z, 0.0)});
}

Vec3 Block::away(Vec3 p) const {
  const Vec3 d = turned(p, inwards_) - middle_;
  Vec3 out{std::abs(d.x) - half_.x, std::abs(d.y) - half_.y, std::abs(d.z) - half_.z};
  const double most = std::max({out.x, out.y, out.z});
  // Outside the block the vector from the nearest point counts, inside it the nearest face.
  if (most > 0) {
    out = {std::max(out.x, 0.0), std::max(out.y, 0.0), std::max(out.z, 0.0)};
  } else {
    out = {out.x == most ? 1.0 : 0.0, out.x < most && out.y == most ? 1.0 : 0.0,
           out.x < most && out.y < most ? 1.0 : 0.0};
  }
  out = (1 / norm(out)) * Vec3{std::copysign(out.x, d.x), std::copysign(out.y, d.y), std::copysign(out.z, d.z)};
  return turned(out, outwards_);
}

Solid Block::solid(double) const {
  const Vec3 low = middle_ - half_, high = middle_ + half_;
  Solid solid;
  solid.x = turned(solid.x, outwards_), solid.y = turned(solid.y, outwards_);
  solid.outline = {{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}};
  solid.from = low.z, solid.to = high.z;
  return solid;
}

std::vector<Block> tool_posts(const StatorPart& part, const ToolPost& post, Coil coil) {
  std::vector<InputFault> faults;
  const auto check = [&](const char* member, double value) {
    if (!(value > 0) || !std::isfinite(value)) faults.push_back({{"tool", member}, "is not a number above 0"});
  };
  check("width", post.width);
  check("thickness", post.thickness);
  check("height", post.height);
  if (!faults.empty()) throw InvalidInput(faults);
  const double r = part.heads.tool_radius, shift = part.heads.tool_shift * (coil.span > 0 ? 1 : -1);
  std::vector<Block> posts;
  for (const bool second : {false, true}) {
    // Tools are shifted towards the coil's middle.
    const double azimuth = (coil.first + (second ? coil.span : 0)) * part.pitch(), at = second ? -shift : shift;
    for (const bool top : {false, true})
      posts.emplace_back(azimuth, Block::Extent{.inner = r - post.thickness,
                                                .outer = r,
                                                .left = at - post.width / 2,
                                                .right = at + post.width / 2,
                                                .low = top ? part.heads.stack : -post.height,
                                                .high = top ? part.heads.stack + post.height : 0.0});
  }
  return posts;
}

}  // namespace bahnwerk::winding
