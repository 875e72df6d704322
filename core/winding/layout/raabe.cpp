#include "core/winding/layout/raabe.hpp"

#include <algorithm>
#include <optional>
#include <utility>

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

Point mirrored(Point p) { return {-p.x, p.y}; }

/// Returns the region's mirror image at the y axis.
Region mirrored(const Region& region) {
  std::vector<Edge> edges;
  for (const Edge& edge : region.edges())
    edges.push_back(
        Edge{mirrored(edge.from), mirrored(edge.to), mirrored(edge.centre), edge.radius, -edge.turn}.reversed());
  std::reverse(edges.begin(), edges.end());
  return Region(std::move(edges));
}

/// Returns the layout of the starts to the right, of several with equally many wires the one with the smallest shift.
std::vector<Point> rightwards(const Region& usable_area, double radius, Progress progress, int shifts) {
  std::vector<Point> best;
  const Sites empty(usable_area, radius, progress);
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
    if (sites.wires().size() > best.size()) best.assign(sites.wires().begin(), sites.wires().end());
  }
  return best;
}

}  // namespace

Layout raabe(const Region& usable_area, double radius, Progress progress, int shifts) {
  const Progress first = progress.part(0, 0.5).named("laying");
  const Progress second = progress.part(0.5, 1).named("laying");
  Layout best{rightwards(usable_area, radius, first, shifts), {}};
  std::vector<Point> leftwards = rightwards(mirrored(usable_area), radius, second, shifts);
  if (leftwards.size() <= best.wires.size()) return best;
  std::transform(leftwards.begin(), leftwards.end(), leftwards.begin(), [](Point p) { return mirrored(p); });
  best.wires = std::move(leftwards);
  return best;
}

}  // namespace bahnwerk::winding
