#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/errors.hpp"
#include "core/geometry/region/fillet.hpp"
#include "core/winding/slot/slot.hpp"
#include "core/winding/slot/slot_faults.hpp"

namespace bahnwerk::winding {
namespace {

/// The outline: base, right flank, tooth tips with the opening between them, left flank.
Region iron(const StatorSlot& s, SlotFaults& faults) {
  const double half = s.base_width / 2;
  if (half >= s.base_radius)
    faults.stop("base_width", "is as wide as the base's circle: less than 2 · base_radius is possible");
  const double corner = s.base_radius - std::sqrt(s.base_radius * s.base_radius - half * half);
  if (s.height <= corner) faults.stop("height", "ends below the corners of the base at " + faults.mm(corner));
  // The flank leans by tip_angle − 90° towards the middle.
  const double top = half - (s.height - corner) * std::tan(s.tip_angle - std::acos(0.0));
  if (top <= 0) faults.stop("tip_angle", "lets the flanks meet below the opening");
  if (s.opening_width > 2 * top)
    faults.add("opening_width", "is wider than the slot at its tooth tips, " + faults.mm(2 * top));
  if (s.height >= s.base_radius + s.liner)
    faults.add("height",
               "reaches the stator's axis: less than base_radius, " + faults.mm(s.base_radius) + ", is possible");
  if (s.wedge_thickness > 0 && !(s.wedge_width > 0))
    faults.add("wedge_width",
               "is 0: a wedge of " + faults.mm(s.wedge_thickness) + " needs its width, or wedge_thickness 0");
  if (s.wedge_thickness >= s.height)
    faults.add("wedge_thickness", "is no less than the slot's height, " + faults.mm(s.height));
  // The given width applies at the wedge's lower side, or at the tooth tips if the slot opens towards them.
  const double lean = (half - top) / (s.height - corner), wide = 2 * (top + std::max(0.0, lean * s.wedge_thickness));
  if (s.wedge_thickness > 0 && s.wedge_width > wide + 1e-9)
    faults.add("wedge_width", "is wider than the slot there, " + faults.mm(wide));
  if (s.opening_width <= 2 * s.tip_corner_radius)
    faults.add("tip_corner_radius", "leaves no opening: twice the radius is less than opening_width");
  faults.stop_if_any();
  const Point left{-half, corner}, right{half, corner};
  std::vector<Edge> loop{arc_between({0, s.base_radius}, left, right, true), line(right, {top, s.height}),
                         line({top, s.height}, {-top, s.height}), line({-top, s.height}, left)};
  // Corners are rounded from the last to the first, since rounding inserts an edge.
  const char* const names[] = {"base_corner_radius", "tip_corner_radius", "tip_corner_radius", "base_corner_radius"};
  for (std::size_t i = 4; i-- > 0;)
    if (!round_corner(loop, i, i % 3 == 0 ? s.base_corner_radius : s.tip_corner_radius))
      faults.stop(names[i], "does not fit between its edges");
  return Region(std::move(loop));
}

Region wedge(const StatorSlot& s, double high) {
  const double half = s.wedge_width / 2, low = s.height - s.wedge_thickness;
  return Region({line({-half, low}, {half, low}), line({half, low}, {half, high}), line({half, high}, {-half, high}),
                 line({-half, high}, {-half, low})});
}

}  // namespace

Slot make_slot(const StatorSlot& s) {
  SlotFaults faults;
  Slot slot;
  slot.type = Slot::Type::stator;
  slot.iron = iron(s, faults);
  slot.usable_area = slot.iron.inward(s.liner);
  if (slot.usable_area.empty()) faults.stop("liner", "leaves no usable area");
  if (s.wedge_thickness > 0 && s.wedge_width > 0) {
    slot.usable_area = slot.usable_area.without(wedge(s, s.height + 1));
    slot.wedge = wedge(s, s.height);
  }
  if (slot.usable_area.empty()) faults.stop("wedge_thickness", "leaves no usable area");
  // The opening does not include the liner, as in [Herrmann Fig. 4.16]: 3.1 mm in the example.
  slot.opening = Opening{{0, s.height}, {0, -1}, s.opening_width - 2 * s.tip_corner_radius, s.liner};
  slot.tension_point = {-4, -4};
  slot.flank_tension_point = {-4, 0};
  slot.flank = -s.tip_angle;
  return slot;
}

}  // namespace bahnwerk::winding
