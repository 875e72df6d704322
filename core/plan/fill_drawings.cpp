#include "core/plan/fill_drawings.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/winding/drawing/drawing.hpp"

namespace bahnwerk {

std::string layout_drawing(const FillRequest& request, const FilledLayout& filled) {
  const winding::Slot& slot = request.slot;
  const double share = filled.electrical / static_cast<double>(request.sides);
  char title[160];
  if (request.sides > 1)
    std::snprintf(title, sizeof title, "%s, %.3g mm: %zu wires of one coil side, %.1f %% copper; %zu of both, %.1f %%",
                  name(filled.algorithm), filled.wire.copper, filled.count(), 100 * share,
                  request.sides * filled.count(), 100 * filled.electrical);
  else
    std::snprintf(title, sizeof title, "%s, %.3g mm: %zu wires, %.1f %% copper", name(filled.algorithm),
                  filled.wire.copper, filled.count(), 100 * filled.electrical);
  winding::DrawnWires drawn{title, filled.wire.radius(), filled.wire.copper, filled.layout.wires,
                            filled.windable.producible_among(filled.wanted()).slipping()};
  if (filled.algorithm == winding::Algorithm::orthocyclic_base) drawn.rows = 0;
  if (filled.algorithm == winding::Algorithm::orthocyclic_flank) drawn.rows = slot.flank;
  for (const auto& each : filled.windable.blocked_among(filled.wanted()))
    if (each.part == winding::Obstruction::Part::channel && !each.back) drawn.unreached = each.wire;
  return slot_drawing(slot, drawn);
}

std::string fill_factor_chart(const FillPlan& plan, const std::string& title) {
  std::vector<winding::FillCurve> curves;
  for (const std::size_t best : plan.best) {
    const winding::Algorithm algorithm = plan.layouts[best].algorithm;
    // One curve per enamel: wires of equal diameter and grade may have different enamels, which belong to different
    // curves.
    std::map<std::pair<int, std::size_t>, winding::FillCurve> by_enamel;
    for (const FilledLayout& each : plan.layouts) {
      if (each.algorithm != algorithm) continue;
      const int grade = winding::nearest_grade(each.wire);
      const auto same = [&](const winding::FillCurve::Value& v) { return v.copper == each.wire.copper; };
      std::size_t which = 0;
      while (std::any_of(by_enamel[{grade, which}].values.begin(), by_enamel[{grade, which}].values.end(), same))
        ++which;
      winding::FillCurve& curve = by_enamel[{grade, which}];
      curve.algorithm = algorithm;
      curve.enamel = "enamel of grade " + std::to_string(grade) + (which ? ", other" : "");
      curve.values.push_back({each.wire.copper, each.electrical, each.mechanical});
    }
    for (auto& [enamel, curve] : by_enamel) curves.push_back(std::move(curve));
  }
  return fill_chart(curves, title);
}

}  // namespace bahnwerk
