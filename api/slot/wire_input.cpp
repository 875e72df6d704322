// One round wire of a spec: a standard one by its copper diameter, or any other.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "api/slot/slot_input.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;
using winding::Wire;

/// The tolerance of the standard wire whose copper diameter is nearest.
double usual_tolerance(double copper, int grade) {
  const auto list = winding::standard_wires(grade, 0, 10, winding::Series::r40);
  return std::min_element(
             list.begin(), list.end(),
             [&](const Wire& a, const Wire& b) { return std::abs(a.copper - copper) < std::abs(b.copper - copper); })
      ->tolerance;
}

}  // namespace

std::string neighbouring_wires(double copper, int grade, winding::Series series) {
  std::string below, above;
  for (const Wire& wire : winding::standard_wires(grade, 0, 10, series)) {
    if (wire.copper < copper) below = short_number(wire.copper);
    if (wire.copper > copper && above.empty()) above = short_number(wire.copper);
  }
  return below.empty() || above.empty() ? below + above : below + " and " + above;
}

std::optional<Wire> read_wire(const json& value, const Place& place, int grade, std::vector<InputFault>& faults) {
  if (value.is_number()) {
    const auto wire = winding::standard_wire(value, grade);
    if (!wire)
      faults.push_back({place, "is no standard wire; the nearest are " +
                                   neighbouring_wires(value, grade, winding::Series::r40) +
                                   ", or give copper and outer diameter"});
    return wire;
  }
  const double copper = value["copper"], outer = value["outer"];
  constexpr double thickest = 3;  // overall by copper diameter: fully insulated wires have up to 2.3
  if (outer < copper) faults.push_back({below(place, "outer"), "is less than the copper diameter"});
  if (outer > thickest * copper)
    faults.push_back({below(place, "outer"), "is more than three times the copper diameter, " + short_number(copper) +
                                                 " mm: no winding wire has so thick an enamel"});
  const auto tolerance = given<double>(value, "tolerance");
  if (tolerance && outer >= copper && *tolerance > 0 && outer * (1 - *tolerance) < copper)
    faults.push_back({below(place, "tolerance"), "lets the overall diameter fall to " +
                                                     short_number(outer * (1 - *tolerance)) +
                                                     " mm, less than the copper's"});
  return Wire{copper, outer, tolerance.value_or(usual_tolerance(copper, grade))};
}

}  // namespace bahnwerk::api
