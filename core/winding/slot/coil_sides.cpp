#include "core/winding/slot/coil_sides.hpp"

#include "core/base/errors.hpp"

namespace bahnwerk::winding {
namespace {

/// Everything to the left of a line through `p` along `direction` as far as a usable area may reach.
Region half_plane(Point p, Point direction, double size) {
  const Point along = size * direction, aside = size * left_of(direction);
  const Point a = p - along, b = p + along, c = b + aside, d = a + aside;
  return Region({line(a, b), line(b, c), line(c, d), line(d, a)});
}

}  // namespace

SharedSlot shared(const Slot& slot, Sharing how) {
  SharedSlot half{slot, slot.usable_area};
  if (slot.type == Slot::Type::rotor) return half;
  const Box& box = slot.usable_area.box();
  const double size = 2 + 2 * distance(box.low, box.high);
  const Point middle = 0.5 * (box.low + box.high);
  const Point up = slot.opening ? -slot.opening->into : Point{0, 1};
  if (how == Sharing::beside) {
    const Point p = slot.opening ? slot.opening->middle : middle;
    half.back = slot.usable_area.without(half_plane(p, up, size));
    half.slot.usable_area = slot.usable_area.without(half_plane(p, -up, size));
  } else {
    // To the left of a line that runs to the right lies what is above it.
    const Point right = -left_of(up);
    double low = -size / 2, high = size / 2;
    for (int k = 0; k < 60; ++k) {
      const double at = (low + high) / 2;
      half.back = slot.usable_area.without(half_plane(middle + at * up, right, size));
      (half.back.area() < slot.usable_area.area() / 2 ? low : high) = at;
    }
    half.back = slot.usable_area.without(half_plane(middle + high * up, right, size));
    half.slot.usable_area = slot.usable_area.without(half_plane(middle + high * up, -right, size));
  }
  half.slot.taken = half.back;
  if (!(half.slot.usable_area.area() > 0) || !(half.back.area() > 0))
    throw InvalidInput(std::vector<InputFault>{{{"coil_sides"}, "leaves no usable area for one of two sides"}});
  return half;
}

}  // namespace bahnwerk::winding
