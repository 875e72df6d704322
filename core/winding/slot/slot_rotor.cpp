#include <cmath>
#include <numbers>
#include <string>

#include "core/geometry/region/crossings.hpp"
#include "core/winding/slot/slot.hpp"
#include "core/winding/slot/slot_faults.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double quarter = std::numbers::pi / 2;

struct Shape {
  double first;      ///< x of the first groove's middle
  double cusp;       ///< height of the ridges between grooves
  Point root, shoe;  ///< directions of the flanks, upwards
};

Shape check(const RotorSlot& s) {
  SlotFaults faults;
  const double first = s.base_width - (s.grooves - 1) * s.groove_pitch;
  if (s.groove_pitch > 2 * s.groove_radius)
    faults.add("groove_radius", "leaves flats between the grooves: at least half of groove_pitch is needed");
  if (first < 0)
    faults.add("base_width", "is too narrow for the grooves, " + faults.mm((s.grooves - 1) * s.groove_pitch));
  if (s.height < s.base_width) faults.add("height", "is less than base_width");
  faults.stop_if_any();
  const double half = s.groove_pitch / 2;
  return {first,
          s.groove_radius - std::sqrt(s.groove_radius * s.groove_radius - half * half),
          {std::cos(s.root_angle), std::sin(s.root_angle)},
          {-std::cos(s.shoe_angle), std::sin(s.shoe_angle)}};
}

/// Returns the outline from the root's corner into the first groove: where the groove's arc leaves the flank or, if it
/// does not reach it, the base.
std::vector<Edge> root(const RotorSlot& s, const Shape& shape, Edge& groove) {
  const Point corner{0, 0}, end = s.root_flank * shape.root;
  const Edge flank = line(end, corner);
  double lowest = -1;
  Meeting found;
  for (const Meeting& m : meetings(flank, groove))
    if (m.first > lowest) {
      lowest = m.first;
      found = m;
    }
  if (lowest < 0) {
    const Point bottom{shape.first, 0};
    groove = groove.part(groove.nearest(bottom), 1);
    if (distance(corner, bottom) < 1e-9) return {flank};
    return {flank, line(corner, groove.from)};
  }
  groove = groove.part(found.second, 1);
  return {flank.part(0, found.first)};
}

}  // namespace

Slot make_slot(const RotorSlot& s) {
  const Shape shape = check(s);
  const double r = s.groove_radius, half = s.groove_pitch / 2;
  std::vector<Edge> loop;
  for (int i = 0; i < s.grooves; ++i) {
    const Point middle{shape.first + i * s.groove_pitch, r}, bottom{middle.x, 0};
    const Point from = i == 0 ? Point{middle.x - r, r} : Point{middle.x - half, shape.cusp};
    const Point to = i + 1 == s.grooves ? bottom : Point{middle.x + half, shape.cusp};
    Edge groove = arc_between(middle, from, to, true);
    if (i == 0) loop = root(s, shape, groove);
    // A single groove that does not reach the root's flank vanishes: the shoe's arc begins at its bottom.
    if (groove.length() > 1e-9) loop.push_back(groove);
  }
  // The last groove ends in the pole shoe's flank.
  const Edge shoe = arc({s.base_width, s.shoe_radius}, s.shoe_radius, -quarter, std::atan2(shape.shoe.y, shape.shoe.x));
  const Point end = shoe.to + s.shoe_flank * shape.shoe;
  loop.push_back(shoe);
  loop.push_back(line(shoe.to, end));
  const Point loop_end = loop.front().from;
  loop.push_back(line(end, loop_end));
  if (self_contact(loop))
    SlotFaults().stop("root_flank", "leaves no usable area: the line from flank end to flank end meets the grooves");
  Slot slot;
  slot.type = Slot::Type::rotor;
  slot.iron = Region(std::move(loop));
  if (!(slot.iron.area() > 0)) SlotFaults().stop("root_flank", "leaves no usable area");
  slot.usable_area = slot.iron;
  // The slot is open from one flank's end to the other's: the needle moves beside the coil, between the poles.
  slot.opening = Opening{0.5 * (end + loop_end), -left_of(unit(end - loop_end)), distance(end, loop_end), 0};
  slot.tension_point = slot.flank_tension_point = {-4, -4};
  slot.flank = s.root_angle;
  return slot;
}

}  // namespace bahnwerk::winding
