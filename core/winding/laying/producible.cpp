#include "core/winding/laying/producible.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/winding/laying/force_balance.hpp"

namespace bahnwerk::winding {
namespace {

/// Calls `found(normal)` for every place where a wire touches the boundary.
template <class Found>
void walls(const Region& usable_area, Point centre, double radius, double gap, Found found) {
  for (const Edge& edge : usable_area.edges()) {
    // A wire that fills an arc touches all of it.
    if (!edge.straight() && distance(centre, edge.centre) <= gap && std::abs(edge.radius - radius) <= gap) {
      for (const double f : {0.0, 0.5, 1.0}) found(unit(centre - edge.at(f)));
      continue;
    }
    const Point at = edge.at(edge.nearest(centre));
    if (distance(at, centre) <= radius + gap) found(unit(centre - at));
  }
}

}  // namespace

std::vector<std::size_t> Producible::slipping() const {
  std::vector<std::size_t> wires = unsupported;
  if (first && !std::binary_search(wires.begin(), wires.end(), first->wire))
    wires.insert(std::upper_bound(wires.begin(), wires.end(), first->wire), first->wire);
  return wires;
}

Producible producible(const Region& usable_area, double radius, const Layout& layout, Point tension_point,
                      const ProducibleOptions& options, Progress progress) {
  Producible result;
  ForceBalance pile(options.friction);
  const double gap = 2 * radius * options.touch + 1e-9, reach = 2 * radius + gap;
  for (std::size_t i = 0; i < layout.wires.size(); ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(layout.wires.size());
    const Progress balancing = progress.part(done, done);
    balancing.report("balancing forces", 0);
    const Point centre = layout.wires[i], to = layout.tension_points.empty() ? tension_point : layout.tension_points[i];
    const Point force = distance(centre, to) > gap ? unit(to - centre) : Point{};
    ForceBalance alone(options.friction);
    alone.add_wire(force);
    pile.add_wire(force);
    const auto touch = [&](std::size_t other, Point normal) {
      alone.add_contact(0, ForceBalance::wall, normal);
      pile.add_contact(i, other, normal);
    };
    walls(usable_area, centre, radius, gap, [&](Point normal) { touch(ForceBalance::wall, normal); });
    for (std::size_t k = 0; k < i; ++k)
      if (square_distance(layout.wires[k], centre) <= reach * reach) touch(k, unit(centre - layout.wires[k]));
    const ForceBalance::Result held = alone.solve(balancing);
    if (!held.balanced) result.unsupported.push_back(i);
    if (result.first) continue;
    if (!held.balanced) {
      result.first = {i, i, Producible::Reason::no_support, held.proves_slip()};
    } else if (const ForceBalance::Result all = pile.solve(balancing); !all.balanced) {
      result.first = {all.fastest, i, Producible::Reason::pushed_out, all.proves_slip()};
    }
  }
  return result;
}

}  // namespace bahnwerk::winding
