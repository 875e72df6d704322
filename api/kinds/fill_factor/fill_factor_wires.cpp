// The wires of a spec of kind "fill_factor": standard ones by a range or by diameters, and arbitrary ones.
#include <nlohmann/json.hpp>

#include "api/kinds/fill_factor/fill_factor_input.hpp"

namespace bahnwerk::api::fill_factor {
namespace {

using nlohmann::json;
using winding::Wire;

class WireReader {
 public:
  WireReader(int grade, std::vector<InputFault>& faults) : grade_(grade), faults_(faults) {}

  std::vector<Wire> read(const json& spec) {
    std::vector<Wire> wires;
    const json list = spec.value("wires", json("standard"));
    if (list.is_string()) return standard(spec.value("wire_range", json::object()));
    for (std::size_t i = 0; i < list.size(); ++i)
      if (const auto wire = read_wire(list[i], {"wires", std::to_string(i)}, grade_, faults_)) wires.push_back(*wire);
    return wires;
  }

 private:
  int grade_;
  std::vector<InputFault>& faults_;

  std::vector<Wire> standard(const json& range) {
    const auto series = range.value("series", "R20") == "R40" ? winding::Series::r40 : winding::Series::r20;
    const double least = range.value("least", 0.5), most = range.value("most", 1.6);
    auto wires = winding::standard_wires(grade_, least, most, series);
    const auto mm = [&](const char* member, double value, double other) {
      return short_number(value, other) + " mm" + (range.contains(member) ? "" : " (the default)");
    };
    if (least > most) {
      faults_.push_back(
          {{"wire_range"}, "is reversed: least is " + mm("least", least, most) + ", most " + mm("most", most, least)});
    } else if (wires.empty()) {
      faults_.push_back({{"wire_range"},
                         "holds no wire of series " + range.value("series", std::string("R20")) + "; the nearest are " +
                             neighbouring_wires(least, grade_, series)});
    }
    return wires;
  }
};

}  // namespace

std::vector<Wire> wires(const json& spec, int grade, std::vector<InputFault>& faults) {
  return WireReader(grade, faults).read(spec);
}

}  // namespace bahnwerk::api::fill_factor
