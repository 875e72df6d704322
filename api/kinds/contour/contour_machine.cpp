// The machine of a spec of kind "contour", but for coarse and fine axes.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "api/kinds/contour/contour.hpp"
#include "api/limits_input.hpp"
#include "api/members.hpp"
#include "core/base/errors.hpp"
#include "core/machine/linear_delta.hpp"
#include "core/machine/linear_machine.hpp"
#include "core/machine/polar_machine.hpp"
#include "core/machine/rotary_delta.hpp"
#include "core/machine/scara_machine.hpp"

namespace bahnwerk::api::contour {
namespace {

using nlohmann::json;
using Configurations = std::vector<std::shared_ptr<const Kinematics>>;
using Faults = std::vector<InputFault>;

constexpr double degree = std::numbers::pi / 180;

/// What a row of the table reads: the axes' maps, and how many coordinates of the tool they move.
struct Read {
  Configurations configurations;
  std::size_t coordinates = 3;
};

AxisLimits axis(const json& document, std::vector<std::string> place, const std::string& name, bool rotary,
                Faults& faults) {
  AxisLimits limits(name, read_limits(document, rotary ? degree : 1));
  if (rotary) limits.unit = "rad";
  if (!(limits.lowest < limits.highest)) {
    place.emplace_back("range");
    faults.push_back({std::move(place), "must go from the lower end to the higher one"});
  }
  return limits;
}

struct NamedAxis {
  const char* name;
  bool rotary;
};
/// Reads the axes that the document has of those; the schema says which are needed.
std::vector<AxisLimits> axes(const json& document, std::initializer_list<NamedAxis> named, Faults& faults) {
  std::vector<AxisLimits> list;
  for (const NamedAxis& each : named)
    if (document["axes"].contains(each.name))
      list.push_back(axis(document["axes"][each.name], {"machine", "axes", each.name}, each.name, each.rotary, faults));
  return list;
}

void take_position(const json& document, const char* name, Vec& value) {
  if (!document.contains(name)) return;
  for (std::size_t k = 0; k < document[name].size(); ++k) value[k] = document[name][k].get<double>();
}

/// Tells whether a name is a capital letter and at most two digits, so that no other column has it.
bool is_axis_name(const std::string& name) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  return !name.empty() && name.size() <= 3 && name[0] >= 'A' && name[0] <= 'Z' &&
         std::all_of(name.begin() + 1, name.end(), digit);
}

Read linear(const json& document, Faults& faults) {
  const json &named = document["axes"], &matrix = document["matrix"];
  std::vector<AxisLimits> list;
  std::vector<Vec> rows;
  std::set<std::string> names;
  const std::size_t coordinates = matrix[0].size();
  for (std::size_t k = 0; k < named.size(); ++k) {
    const std::string name = named[k]["name"].get<std::string>(), at = std::to_string(k);
    if (!is_axis_name(name))
      faults.push_back({{"machine", "axes", at, "name"}, "must be a capital letter and at most two digits"});
    if (!names.insert(name).second) faults.push_back({{"machine", "axes", at, "name"}, "is the name of another axis"});
    list.push_back(axis(named[k], {"machine", "axes", at}, name, false, faults));
  }
  if (matrix.size() != named.size())
    faults.push_back(
        {{"machine", "matrix"},
         "has " + std::to_string(matrix.size()) + " rows, there are " + std::to_string(named.size()) + " axes"});
  for (std::size_t k = 0; k < matrix.size(); ++k) {
    rows.emplace_back();
    for (std::size_t i = 0; i < matrix[k].size(); ++i) rows.back()[i] = matrix[k][i].get<double>();
    const std::vector<std::string> place{"machine", "matrix", std::to_string(k)};
    if (matrix[k].size() != coordinates)
      faults.push_back({place, "has another number of coordinates than the first row"});
    else if (norm(rows.back()) == 0)
      faults.push_back({place, "must not be zero: no move would move the axis"});
  }
  if (!faults.empty()) return {};
  try {
    return {{std::make_shared<const LinearMachine>(std::move(list), rows, coordinates)}, coordinates};
  } catch (const std::invalid_argument&) {
    faults.push_back({{"machine", "matrix"}, "does not determine the tool's position: some moves move no axis"});
    return {};
  }
}

Read corexy(const json& document, Faults& faults) {
  std::vector<AxisLimits> list = axes(document, {{"A", false}, {"B", false}, {"z", false}}, faults);
  const std::size_t coordinates = list.size();
  std::vector<Vec> rows{{1, 1, 0}, {1, -1, 0}, {0, 0, 1}};
  rows.resize(coordinates);
  return {{std::make_shared<const LinearMachine>(std::move(list), rows, coordinates)}, coordinates};
}

Read polar(const json& document, Faults& faults) {
  PolarSizes sizes;
  take_position(document, "origin", sizes.origin);
  take(document, "least_radius", sizes.least_radius);
  std::vector<AxisLimits> list = axes(document, {{"theta", true}, {"r", false}, {"z", false}}, faults);
  const std::size_t coordinates = list.size();
  return {{std::make_shared<const PolarMachine>(sizes, std::move(list))}, coordinates};
}

Read scara(const json& document, Faults& faults) {
  ScaraSizes sizes;
  take_position(document, "origin", sizes.origin);
  take(document, "l1", sizes.l1);
  take(document, "l2", sizes.l2);
  take(document, "least_bend", sizes.least_bend, degree);
  const std::vector<AxisLimits> list = axes(document, {{"theta1", true}, {"theta2", true}, {"z", false}}, faults);
  const std::string elbow = document.value("elbow", "best");
  Read read{{}, list.size()};
  for (const bool right : {true, false})
    if (elbow == "best" || (elbow == "right") == right) {
      sizes.right = right;
      read.configurations.push_back(std::make_shared<const ScaraMachine>(sizes, list));
    }
  return read;
}

Read linear_delta(const json& document, Faults& faults) {
  LinearDeltaSizes sizes;
  take_position(document, "origin", sizes.origin);
  take(document, "radius", sizes.radius);
  take(document, "rod", sizes.rod);
  take(document, "least_angle", sizes.least_angle, degree);
  if (!(sizes.rod * std::cos(sizes.least_angle) > sizes.radius))
    faults.push_back({{"machine", "rod"}, "is too short: the tool would not reach the middle between the columns"});
  return {
      {std::make_shared<const LinearDelta>(sizes, axes(document, {{"A", false}, {"B", false}, {"C", false}}, faults))},
      3};
}

Read rotary_delta(const json& document, Faults& faults) {
  RotaryDeltaSizes sizes;
  take_position(document, "origin", sizes.origin);
  take(document, "radius", sizes.radius);
  take(document, "arm", sizes.arm);
  take(document, "rod", sizes.rod);
  take(document, "least_bend", sizes.least_bend, degree);
  return {{std::make_shared<const RotaryDelta>(
              sizes, axes(document, {{"theta1", true}, {"theta2", true}, {"theta3", true}}, faults))},
          3};
}

/// The machines by their names in documents. A new machine is one more row.
struct Row {
  const char* name;
  Read (*read)(const json& document, Faults& faults);
};
constexpr Row rows[] = {{"linear", linear},
                        {"corexy", corexy},
                        {"polar", polar},
                        {"scara", scara},
                        {"linear_delta", linear_delta},
                        {"rotary_delta", rotary_delta}};

}  // namespace

ToolMachine machine(const json& spec) {
  const json& document = spec["machine"];
  const double cycle_time = document.value("cycle_time", 0.001);
  const std::string kinematics = document.value("kinematics", "cartesian");
  if (kinematics == "cartesian") {
    Machine machine;
    machine.cycle_time = cycle_time;
    for (const char* name : {"x", "y", "z"})
      if (document["axes"].contains(name)) machine.axes.emplace_back(name, read_limits(document["axes"][name]));
    return machine;
  }
  for (const Row& row : rows) {
    if (kinematics != row.name) continue;
    Faults faults;
    Read read = row.read(document, faults);
    if (!faults.empty()) throw InvalidInput(std::move(faults));
    return {std::move(read.configurations), cycle_time, read.coordinates};
  }
  throw std::logic_error("a machine that the schema does not know");
}

}  // namespace bahnwerk::api::contour
