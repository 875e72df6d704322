#include "core/winding/slot/coil_sides.hpp"

#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "core/base/errors.hpp"

namespace bahnwerk::winding {
namespace {

/// Returns the half-plane to the left of the line through `p` along `direction`, as far as a usable area may extend.
Region half_plane(Point p, Point direction, double size) {
  const Point along = size * direction, aside = size * left_of(direction);
  const Point a = p - along, b = p + along, c = b + aside, d = a + aside;
  return Region({line(a, b), line(b, c), line(c, d), line(d, a)});
}

void require_area(const Region& side) {
  if (!(side.area() > 0))
    throw InvalidInput(std::vector<InputFault>{{{"coil_sides"}, "leaves no usable area for one of two sides"}});
}

}  // namespace

SharedSlot shared(const Slot& slot, Sharing how) {
  SharedSlot half{slot, slot.usable_area};
  if (slot.type == Slot::Type::rotor) return half;
  require_area(slot.usable_area);
  const Box& box = slot.usable_area.box();
  const double size = 2 + 2 * distance(box.low, box.high);
  const Point middle = 0.5 * (box.low + box.high);
  const Point up = slot.opening ? -slot.opening->into : Point{0, 1};
  if (how == Sharing::beside) {
    const Point p = slot.opening ? slot.opening->middle : middle;
    half.back = slot.usable_area.without(half_plane(p, up, size));
    half.slot.usable_area = slot.usable_area.without(half_plane(p, -up, size));
  } else {
    // The left side of a line that runs to the right is the part above it.
    const Point right = -left_of(up);
    const auto below = [&](double at) { return slot.usable_area.without(half_plane(middle + at * up, right, size)); };
    // Only the sign is used: rounding makes the difference 0 at several heights, the lowest of which is the border.
    const auto side = [&](double at) { return below(at).area() < slot.usable_area.area() / 2 ? -1.0 : 1.0; };
    const auto adjacent = [](double low, double high) { return std::nextafter(low, high) >= high; };
    const double border = boost::math::tools::bisect(side, -size / 2, size / 2, adjacent).second;
    half.back = below(border);
    half.slot.usable_area = slot.usable_area.without(half_plane(middle + border * up, -right, size));
  }
  half.slot.taken = half.back;
  require_area(half.slot.usable_area);
  require_area(half.back);
  return half;
}

}  // namespace bahnwerk::winding
