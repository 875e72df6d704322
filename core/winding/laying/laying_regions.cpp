#include "core/winding/laying/laying_regions.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/base/errors.hpp"

namespace bahnwerk::winding {
namespace {

Region rectangle(double width, double height) {
  return Region({line({0, 0}, {width, 0}), line({width, 0}, {width, height}), line({width, height}, {0, height}),
                 line({0, height}, {0, 0})});
}

/// Returns the point at which the line from `foot` to `end` reaches `height`.
Point raised(Point foot, Point end, double height) {
  if (!(end.y > foot.y)) throw std::invalid_argument("a flank does not rise from the base");
  return foot + ((height - foot.y) / (end.y - foot.y)) * (end - foot);
}

[[noreturn]] void refuse_cap_height(const char* why) { throw InvalidInput({{{"heads", "cap_height"}, why}}); }

/// Returns the rotor slot's outline with its flanks extended to `height`.
Region cap(const Region& slot, double height) {
  const auto edges = slot.edges();
  // The line that closes the slot runs back above the base.
  std::size_t closing = 0;
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i].straight() && edges[i].direction(0).x < edges[closing].direction(0).x) closing = i;
  std::vector<Edge> outline;
  for (std::size_t i = 1; i < edges.size(); ++i) outline.push_back(edges[(closing + i) % edges.size()]);
  if (outline.size() < 2 || !outline.front().straight() || !outline.back().straight())
    throw std::invalid_argument("a rotor slot ends in straight flanks");
  if (height <= std::max(outline.front().to.y, outline.back().from.y))
    refuse_cap_height("ends below the grooves of the end cap: more than cap_base is needed");
  outline.front().from = raised(outline.front().to, outline.front().from, height);
  outline.back().to = raised(outline.back().from, outline.back().to, height);
  if (outline.back().to.x <= outline.front().from.x) refuse_cap_height("lets the flanks meet below it");
  outline.push_back(line(outline.back().to, outline.front().from));
  return Region(std::move(outline));
}

}  // namespace

Vec3 Frame::place(Point p) const { return origin + p.x * x + p.y * y; }
Point Frame::foot(Vec3 p) const {
  const Vec3 d = p - origin;
  return {dot(d, x), dot(d, y)};
}

Vec3 LayingRegions::held(std::size_t j, Point place) const {
  const Vec3 begin = at[j].begin.place(place), end = at[j].end.place(place), back = begin - end;
  const double length = std::sqrt(dot(back, back));
  return end + (length > 0 ? hold / length : 0) * back;
}

LayingRegions laying_regions(const Slot& slot, const StatorHeads& h) {
  struct Side {
    Vec3 radial, tangential;
  };
  const auto side = [&](int slots) {
    const double a = -slots * h.slot_pitch;
    return Side{{std::cos(a), std::sin(a), 0}, {-std::sin(a), std::cos(a), 0}};
  };
  const Side first = side(0), second = side(h.span);
  const auto in_slot = [&](const Side& s, double z) {
    return Frame{h.base_radius * s.radial + Vec3{0, 0, z}, s.tangential, -1.0 * s.radial};
  };
  const auto at_tool = [&](const Side& s, double shift, bool top) {
    const Vec3 axial{0, 0, top ? h.stack + h.tool_height : -h.tool_height};
    return Frame{h.tool_radius * s.radial + shift * s.tangential + axial, s.radial, {0, 0, top ? 1.0 : -1.0}};
  };
  // The size exceeds any pile of the wires that the slot holds.
  const Point size = slot.usable_area.box().high - slot.usable_area.box().low;
  const Region head = rectangle(2 * std::max(size.x, size.y), 2 * std::max(size.x, size.y));
  LayingRegions regions;
  regions.at[0] = {slot.usable_area, in_slot(first, h.stack), in_slot(first, 0)};
  regions.at[1] = {head, at_tool(first, -h.tool_shift, false), at_tool(second, h.tool_shift, false)};
  regions.at[2] = {slot.usable_area, in_slot(second, 0), in_slot(second, h.stack)};
  regions.at[3] = {head, at_tool(second, h.tool_shift, true), at_tool(first, -h.tool_shift, true)};
  return regions;
}

LayingRegions laying_regions(const Slot& slot, const RotorHeads& h) {
  const double low = -h.cap_base, high = h.stack + h.cap_base, half = h.tooth_half_width;
  // Both slots are mirror images at the tooth: y from the tooth outwards, x along it.
  const auto in_slot = [&](double side, double z) {
    return Frame{{h.tooth_radius, side * half, z}, {1, 0, 0}, {0, side, 0}};
  };
  const auto on_cap = [&](double y, bool top) {
    return Frame{{h.tooth_radius, y, top ? high : low}, {1, 0, 0}, {0, 0, top ? 1.0 : -1.0}};
  };
  const Region head = cap(slot.usable_area, h.cap_height - h.cap_base);
  LayingRegions regions;
  regions.at[0] = {slot.usable_area, in_slot(-1, high), in_slot(-1, low)};
  regions.at[1] = {head, on_cap(-half, false), on_cap(half, false)};
  regions.at[2] = {slot.usable_area, in_slot(1, low), in_slot(1, high)};
  regions.at[3] = {head, on_cap(half, true), on_cap(-half, true)};
  regions.hold = h.hold;
  return regions;
}

}  // namespace bahnwerk::winding
