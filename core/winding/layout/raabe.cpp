#include "core/winding/layout/raabe.hpp"

#include <optional>

#include "core/base/progress.hpp"
#include "core/winding/layout/sites.hpp"

namespace bahnwerk::winding {
namespace {

constexpr Point up{0, 1};

/// Returns the lowest place of a first wire at this x.
std::optional<Point> lowest_at(double x, const Sites& sites, const Box& box) {
  const Edge upright = line({x, box.low.y - 1}, {x, box.high.y + 1});
  std::optional<Point> lowest;
  for (const Edge& border : sites.borders())
    for (const Meeting& m : meetings(upright, border))
      if (const Point p = upright.at(m.first); !lowest || p.y < lowest->y) lowest = p;
  return lowest;
}

}  // namespace

Layout raabe(const Region& usable_area, double radius, Progress& progress, int shifts) {
  Layout best;
  const Sites empty(usable_area, radius, &progress);
  Sites search = empty;
  const std::optional<Point> initial = search.least(up);
  if (!initial) return best;
  const double most = usable_area.area() / (radius * radius * 3);
  for (int shift = 0; shift < shifts; ++shift) {
    const double x = initial->x + shift * radius / shifts;
    std::optional<Point> place = shift == 0 ? initial : lowest_at(x, empty, usable_area.box());
    Sites sites = empty;
    for (; place; place = sites.least(up)) {
      sites.lay(*place);
      const double share = static_cast<double>(sites.wires().size()) / (most + 1);
      progress.report("laying", (shift + (share < 1 ? share : 1)) / shifts);
    }
    if (sites.wires().size() > best.wires.size()) best.wires.assign(sites.wires().begin(), sites.wires().end());
  }
  return best;
}

}  // namespace bahnwerk::winding
