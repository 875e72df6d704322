// The machine of a spec of kind "winding".
#include <nlohmann/json.hpp>
#include <numbers>

#include "api/kinds/winding/winding_input.hpp"
#include "api/limits_input.hpp"
#include "core/machine/horizontal_winder.hpp"
#include "core/machine/robot_winder.hpp"
#include "core/machine/vertical_winder.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;
using Machines = std::vector<std::shared_ptr<const Kinematics>>;

constexpr double degree = std::numbers::pi / 180;

PartPlace place(const json& document, PartPlace standing) {
  if (!document.contains("part")) return standing;
  const json& part = document["part"];
  if (part.contains("origin"))
    for (std::size_t k = 0; k < 3; ++k) standing.origin[k] = part["origin"][k].get<double>();
  take(part, "angle", standing.angle, degree);
  return standing;
}

/// Reads the limits of the five axes in mm or, where `rotary`, in rad.
std::vector<Limits> limits(const json& document, const std::array<bool, 5>& rotary, Faults& faults) {
  std::vector<Limits> list(5);
  for (std::size_t k = 0; k < 5; ++k) {
    const std::string name = "q" + std::to_string(k + 1);
    const json& axis = document["axes"][name];
    const double unit = rotary[k] ? degree : 1;
    list[k] = read_limits(axis, unit);
    if (list[k].lowest > list[k].highest)
      faults.push_back({{"machine", "axes", name, "range"}, "ends below where it begins"});
  }
  return list;
}

Machines robot(const json& document, Faults& faults) {
  RobotWinderSizes sizes;
  take(document, "l1", sizes.l1);
  take(document, "l2", sizes.l2);
  take(document, "o_tool", sizes.o_tool);
  take(document, "l_tool", sizes.l_tool);
  sizes.least_bend = 0.5 * degree;
  take(document, "least_bend", sizes.least_bend, degree);
  sizes.part = place(document, sizes.part);
  const auto axes = limits(document, {true, true, false, true, true}, faults);
  const std::string arm = document.value("arm", "best");
  Machines arms;
  if (arm != "righty") arms.push_back(std::make_shared<const RobotWinder>(sizes, RobotArm::lefty, axes));
  if (arm != "lefty") arms.push_back(std::make_shared<const RobotWinder>(sizes, RobotArm::righty, axes));
  return arms;
}

Machines vertical(const json& document, Faults& faults) {
  VerticalWinderSizes sizes;
  take(document, "d_upper", sizes.d_upper);
  take(document, "a_upper", sizes.a_upper);
  take(document, "d_lower", sizes.d_lower);
  take(document, "a_lower", sizes.a_lower);
  take(document, "o_tool", sizes.o_tool);
  take(document, "l_tool", sizes.l_tool);
  sizes.part = place(document, sizes.part);
  return {std::make_shared<const VerticalWinder>(sizes, limits(document, {false, false, true, true, false}, faults))};
}

Machines horizontal(const json& document, Faults& faults) {
  HorizontalWinderSizes sizes;
  take(document, "z_part", sizes.z_part);
  take(document, "l_tool", sizes.l_tool);
  sizes.part = place(document, sizes.part);
  return {std::make_shared<const HorizontalWinder>(sizes, limits(document, {false, false, false, true, true}, faults))};
}

/// The machines by their names in documents. A new machine is one more row.
struct Row {
  const char* name;
  Machines (*read)(const json& document, Faults& faults);
};
constexpr Row rows[] = {{"robot", robot}, {"vertical", vertical}, {"horizontal", horizontal}};

}  // namespace

PoseFrame pose_frame(const json& spec) {
  const json& document = spec["machine"];
  const PartPlace standing = document["type"] == "robot"      ? RobotWinderSizes{}.part
                             : document["type"] == "vertical" ? VerticalWinderSizes{}.part
                                                              : HorizontalWinderSizes{}.part;
  const PartPlace part = place(document, standing);
  return {part.origin.x, part.origin.y, part.origin.z, part.angle / degree};
}

double swivel_length(const json& spec) {
  const json& document = spec["machine"];
  double length = RobotWinderSizes{}.l_tool;
  if (document["type"] == "vertical") length = VerticalWinderSizes{}.l_tool;
  if (document["type"] == "horizontal") length = HorizontalWinderSizes{}.l_tool;
  take(document, "l_tool", length);
  return length;
}

Machines machine(const json& spec, Faults& faults) {
  const json& document = spec["machine"];
  for (const Row& row : rows)
    if (document["type"] == row.name) return row.read(document, faults);
  throw std::logic_error("a machine that the schema does not know");
}

}  // namespace bahnwerk::api::winding_kind
