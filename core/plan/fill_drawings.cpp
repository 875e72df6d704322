#include "core/plan/fill_drawings.hpp"

#include <cstdio>
#include <vector>

#include "core/winding/drawing/drawing.hpp"

namespace bahnwerk {

std::string layout_drawing(const winding::Slot& slot, const FilledLayout& filled) {
  char title[120];
  std::snprintf(title, sizeof title, "%s, %.3g mm: %zu wires, %.1f %% copper", name(filled.algorithm),
                filled.wire.copper, filled.count(), 100 * filled.electrical);
  winding::DrawnWires drawn{title, filled.wire.radius(), filled.wire.copper, filled.layout.wires,
                            filled.producible.slipping()};
  for (const auto& each : filled.blocked)
    if (each.part == winding::Obstruction::Part::channel && !each.back) drawn.unreached = each.wire;
  return slot_drawing(slot, drawn);
}

std::string fill_factor_chart(const FillPlan& plan, const std::string& title) {
  std::vector<winding::FillCurve> curves;
  for (const std::size_t best : plan.best) {
    curves.push_back({plan.layouts[best].algorithm, {}});
    for (const FilledLayout& each : plan.layouts)
      if (each.algorithm == curves.back().algorithm)
        curves.back().values.push_back({each.wire.copper, each.electrical, each.mechanical});
  }
  return fill_chart(curves, title);
}

}  // namespace bahnwerk
