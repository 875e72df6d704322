// The wires of a spec of kind "fill_factor": standard ones by range or diameter, and any others.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "api/kinds/fill_factor_input.hpp"

namespace bahnwerk::api::fill_factor {
namespace {

using nlohmann::json;
using winding::Wire;

/// Standard wires on both sides of a diameter that none has.
std::string neighbours(double copper, int grade) {
  std::string below, above;
  for (const Wire& wire : winding::standard_wires(grade, 0, 10, winding::Series::r40)) {
    if (wire.copper < copper) below = short_number(wire.copper);
    if (wire.copper > copper && above.empty()) above = short_number(wire.copper);
  }
  return below.empty() || above.empty() ? below + above : below + " and " + above;
}

/// The tolerance of the standard wire whose copper diameter is nearest.
double usual_tolerance(double copper, int grade) {
  const auto list = winding::standard_wires(grade, 0, 10, winding::Series::r40);
  return std::min_element(
             list.begin(), list.end(),
             [&](const Wire& a, const Wire& b) { return std::abs(a.copper - copper) < std::abs(b.copper - copper); })
      ->tolerance;
}

class WireReader {
 public:
  WireReader(int grade, std::vector<InputFault>& faults) : grade_(grade), faults_(faults) {}

  std::vector<Wire> read(const json& spec) {
    std::vector<Wire> wires;
    const json list = spec.value("wires", json("standard"));
    if (list.is_string()) return standard(spec.value("wire_range", json::object()));
    for (std::size_t i = 0; i < list.size(); ++i)
      if (const auto wire = read_one(list[i], std::to_string(i))) wires.push_back(*wire);
    return wires;
  }

 private:
  int grade_;
  std::vector<InputFault>& faults_;

  std::vector<Wire> standard(const json& range) {
    const auto series = range.value("series", "R20") == "R40" ? winding::Series::r40 : winding::Series::r20;
    const double least = range.value("least", 0.5), most = range.value("most", 1.6);
    auto wires = winding::standard_wires(grade_, least, most, series);
    if (wires.empty())
      faults_.push_back({{"wire_range"}, "holds no standard wire; one is " + neighbours(least, grade_)});
    return wires;
  }

  std::optional<Wire> read_one(const json& value, const std::string& index) {
    if (value.is_number()) {
      const auto wire = winding::standard_wire(value, grade_);
      if (!wire)
        faults_.push_back({{"wires", index},
                           "is no standard wire; the nearest are " + neighbours(value, grade_) +
                               ", or give copper and outer diameter"});
      return wire;
    }
    const double copper = value["copper"], outer = value["outer"];
    if (outer < copper) faults_.push_back({{"wires", index, "outer"}, "is less than the copper diameter"});
    return Wire{copper, outer, given<double>(value, "tolerance").value_or(usual_tolerance(copper, grade_))};
  }
};

}  // namespace

std::vector<Wire> wires(const json& spec, int grade, std::vector<InputFault>& faults) {
  return WireReader(grade, faults).read(spec);
}

}  // namespace bahnwerk::api::fill_factor
