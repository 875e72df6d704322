#include "core/winding/part/part.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "core/base/errors.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

[[noreturn]] void refuse(std::vector<std::string> place, const std::string& why) {
  throw InvalidInput({{std::move(place), why}});
}

void check_numbers(int from, int to, int slots) {
  std::vector<InputFault> faults;
  const int given[] = {from, to};
  for (int i = 0; i < 2; ++i)
    if (given[i] < 0 || given[i] > slots)
      faults.push_back({{"coil", "slots", std::to_string(i)}, "is none of the slots 0 to " + std::to_string(slots)});
  if (!faults.empty()) throw InvalidInput(faults);
}

int reduced(int n, int slots) { return ((n % slots) + slots) % slots; }

/// Tells whether the outline stays on the right of the line through `on` along `direction`.
bool right_of(const Region& outline, Point on, Point direction) {
  const Point left = left_of(direction);
  for (const Edge& e : outline.edges()) {
    std::vector<Point> farthest{e.from, e.to};
    // The point of an arc that lies farthest to the left counts.
    if (!e.straight()) farthest.push_back(e.at(e.nearest(e.centre + 2 * e.radius * left)));
    for (const Point p : farthest)
      if (dot(p - on, left) >= 0) return false;
  }
  return true;
}

Frame placed(const Frame& f, bool mirrored, double angle) {
  const auto move = [&](Vec3 a) { return turned(mirrored ? Vec3{a.x, -a.y, a.z} : a, angle); };
  return {move(f.origin), move(f.x), move(f.y)};
}

LayingRegions placed(LayingRegions regions, bool mirrored, double angle) {
  for (LayingRegion& r : regions.at) {
    r.begin = placed(r.begin, mirrored, angle);
    r.end = placed(r.end, mirrored, angle);
  }
  return regions;
}

}  // namespace

StatorPart drawn_stator(const PolygonSlot& slot, double base_radius) {
  if (!slot.opening) refuse({"slot", "opening"}, "is needed: where wire and needle get in");
  StatorPart part;
  part.drawn = upright(slot).slot;
  const Slot section = make_slot(*part.drawn);
  const Point size = section.iron.box().high - section.iron.box().low;
  part.slot = {};
  part.slot.base_width = size.x;
  part.slot.height = section.opening->middle.y;
  part.slot.opening_width = section.opening->clear;
  part.slot.tip_corner_radius = part.slot.base_corner_radius = 0;
  part.slot.base_radius = part.heads.base_radius = base_radius;
  part.slot.liner = slot.liner;
  part.slot.wedge_thickness = part.slot.wedge_width = 0;
  return part;
}

Coil coil_between(const StatorPart& part, int from, int to) {
  check_numbers(from, to, part.slots);
  int span = to - from;
  if (2 * std::abs(span) > part.slots) span -= span > 0 ? part.slots : -part.slots;
  if (span == 0) refuse({"coil", "slots"}, "names the same slot twice");
  return {from, span};
}

Coil coil_between(const RotorPart& part, int from, int to) {
  check_numbers(from, to, part.poles);
  const int span = to - from;
  if (std::abs(span) == 1) return {from, span};
  if (reduced(span, part.poles) == 1) return {from, 1};
  if (reduced(span, part.poles) == part.poles - 1) return {from, -1};
  refuse({"coil", "slots"}, "a rotor's coil lies about one pole: its slots are neighbours");
}

Coil reversed(Coil coil) { return {coil.first + coil.span, -coil.span}; }

std::vector<Coil> repeated(Coil coil, int slots, int step, std::size_t count, bool alternate) {
  std::vector<Coil> coils;
  long long first = coil.first;
  for (std::size_t i = 0; i < count; ++i, first = (first + step) % slots) {
    Coil next{reduced(static_cast<int>(first % slots), slots), coil.span};
    if (alternate && i % 2 == 1) next = reversed(next);
    next.first = reduced(next.first, slots);
    coils.push_back(next);
  }
  return coils;
}

Slot checked_slot(const StatorPart& part) {
  Slot slot = part.drawn ? make_slot(*part.drawn) : make_slot(part.slot);
  if (part.slots < 2) refuse({"part", "slots"}, "is less than 2: a coil needs two slots");
  if (part.heads.base_radius <= part.slot.height)
    refuse({"part", "base_radius"}, "is no more than the slot's height: the slot would reach the stator's axis");
  if (!leaves_teeth(slot, part.heads.base_radius, part.pitch()))
    refuse({"part", "slots"}, "leaves no tooth between the slots: fewer slots or a larger radius are needed");
  return slot;
}

Slot checked_slot(const RotorPart& part) {
  Slot slot = make_slot(part.slot);
  if (part.poles < 2) refuse({"part", "poles"}, "is less than 2");
  // The line between two poles, in slot coordinates, from the axis outwards. The slot lies on its right.
  const double half = part.pitch() / 2;
  const Point axis{-part.heads.tooth_radius, -part.heads.tooth_half_width}, middle{std::cos(half), std::sin(half)};
  if (!right_of(slot.iron, axis, middle))
    refuse({"part", "poles"},
           "lets neighbouring coils reach into each other: fewer poles or a larger radius are needed");
  return slot;
}

bool leaves_teeth(const Slot& slot, double base_radius, double pitch) {
  // The middle of the adjacent tooth in slot coordinates, from the axis outwards.
  return right_of(slot.iron, {0, base_radius}, {std::sin(pitch / 2), -std::cos(pitch / 2)});
}

double bore(const StatorPart& part) { return 2 * (part.heads.base_radius - part.slot.height); }

double outer_radius(const RotorPart& part, const Slot& slot) {
  double outer = 0;
  for (const Edge& edge : slot.iron.edges())
    outer =
        std::max(outer, std::hypot(part.heads.tooth_radius + edge.from.x, part.heads.tooth_half_width + edge.from.y));
  return outer;
}

double clear_way(const StatorPart&, const Slot& slot) { return slot.opening->clear; }

double clear_way(const RotorPart& part, const Slot& slot) {
  // The plane between two poles, in slot coordinates.
  const double half = part.pitch() / 2;
  const Point axis{-part.heads.tooth_radius, -part.heads.tooth_half_width}, middle{std::cos(half), std::sin(half)};
  double nearest = std::numeric_limits<double>::infinity();
  for (const Edge& e : slot.iron.edges()) nearest = std::min(nearest, -dot(e.from - axis, left_of(middle)));
  return 2 * nearest;
}

LayingRegions coil_regions(const StatorPart& part, const Slot& slot, Coil coil) {
  StatorHeads heads = part.heads;
  heads.slot_pitch = part.pitch();
  heads.span = std::abs(coil.span);
  if (heads.span == 0) refuse({"coil", "slots"}, "names the same slot twice");
  if (2 * std::atan2(heads.tool_shift, heads.tool_radius) >= heads.span * heads.slot_pitch)
    refuse({"part", "tool_shift"}, "lets the winding tools of the coil's two sides pass each other");
  // laying_regions has the second slot clockwise from the first.
  return placed(laying_regions(slot, heads), coil.span > 0, coil.first * part.pitch());
}

LayingRegions coil_regions(const RotorPart& part, const Slot& slot, Coil coil) {
  if (std::abs(coil.span) != 1)
    refuse({"coil", "slots"}, "a rotor's coil lies about one pole: its slots are neighbours");
  // laying_regions begins in the slot on the clockwise side of the pole (4.23).
  const int pole = coil.span > 0 ? coil.first : coil.first - 1;
  return placed(laying_regions(slot, part.heads), coil.span < 0, pole * part.pitch());
}

}  // namespace bahnwerk::winding
