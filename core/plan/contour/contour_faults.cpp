#include "core/plan/contour/contour_faults.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/plan/planning_method.hpp"

namespace bahnwerk {
namespace {

bool limits_jerk(const Machine& machine, std::size_t axes) {
  return std::any_of(machine.axes.begin(),
                     machine.axes.begin() + static_cast<std::ptrdiff_t>(std::min(axes, machine.dimension())),
                     [](const AxisLimits& axis) { return axis.jerk < unlimited; });
}

/// Returns the place of a missing limit of jerk: that of the first axis on a Cartesian machine, else all axes.
std::vector<std::string> jerk_place(const Machine& machine) {
  if (!machine.axes.empty() && machine.axes.front().name != "x") return {"machine", "axes"};
  return {"machine", "axes", "x", "jerk"};
}

}  // namespace

std::vector<InputFault> machine_faults(const Machine& machine) {
  std::vector<InputFault> faults;
  const auto fault = [&](std::vector<std::string> place, std::string message) {
    place.insert(place.begin(), "machine");
    faults.push_back({std::move(place), std::move(message)});
  };
  if (!(machine.cycle_time > 0) || !std::isfinite(machine.cycle_time))
    fault({"cycle_time"}, "must be a positive number, s");
  for (const AxisLimits& axis : machine.axes) {
    for (int order = 1; order <= Limits::highest_order; ++order)
      if (!(axis.of(order) > 0) || (order == 2 && !std::isfinite(axis.of(order))))
        fault({"axes", axis.name, derivative_name(order)}, "must be a positive number");
    if (!(axis.lowest < axis.highest))
      fault({"axes", axis.name, "range"}, "must go from the lower end to the higher one");
  }
  return faults;
}

void check_axes(const Contour& contour, const Machine& head, const char* member, std::vector<InputFault>& faults) {
  static constexpr const char* names[] = {"x", "y", "z"};
  for (std::size_t k = head.dimension(); k < contour.dimension; ++k)
    faults.push_back({{"machine", member, names[k]},
                      k < 2 ? "is required: the contour moves it" : "is required: the contour is in space"});
}

double shortest_time(const Contour& contour, const ToolMachine& head) {
  double fastest = head.cartesian() ? 0 : unlimited, time = contour.dwell();
  for (std::size_t k = 0; head.cartesian() && k < std::min(head.dimension(), contour.dimension); ++k)
    fastest += head.axes[k].velocity * head.axes[k].velocity;
  fastest = std::sqrt(fastest);
  for (const auto& block : contour.blocks)
    for (std::size_t i = block.first; i < block.last; ++i)
      time += contour.path[i].length() / std::min(block.feed, fastest);
  return time;
}

void check_setpoints(double shortest, const Machine& head, double max_setpoints, std::vector<InputFault>& faults) {
  if (shortest / head.cycle_time > max_setpoints)
    faults.push_back({{"machine", "cycle_time"},
                      "the motion would have more than " + std::to_string(static_cast<long>(max_setpoints)) +
                          " setpoints: lengthen the cycle, raise the speeds, shorten the dwells or split the contour"});
}

void check_corners(const ContourPlanning& planning, std::vector<InputFault>& faults) {
  if (planning.corner_mode == CornerMode::blend && !(planning.blend_tolerance > 0))
    faults.push_back({{"planning", "corner", "tolerance"}, "is required by mode blend"});
  if (planning.corner_mode == CornerMode::stop && planning.blend_tolerance > 0)
    faults.push_back({{"planning", "corner", "tolerance"}, "belongs to mode blend"});
}

std::vector<InputFault> planning_faults(const Machine& machine, const ContourPlanning& planning) {
  std::vector<InputFault> faults;
  const bool smooth = method_row(planning.method).order == 3;
  if (smooth && !limits_jerk(machine, machine.dimension()) && !(planning.along.jerk < unlimited))
    faults.push_back({jerk_place(machine), "is required by method jerk_limited, of one axis at least"});
  const Limits& path = planning.along;
  if (!smooth && std::min({path.velocity, path.acceleration, path.jerk}) < unlimited)
    faults.push_back(
        {{"planning", "path"}, "is held by method jerk_limited only; blocks limit the speed by their feed"});
  check_corners(planning, faults);
  return faults;
}

std::vector<InputFault> contour_faults(const Contour& contour, const ToolMachine& machine,
                                       const ContourPlanning& planning) {
  std::vector<InputFault> faults;
  if (contour.path.empty()) faults.push_back({{"contour"}, "has no segments"});
  if (machine.cartesian())
    check_axes(contour, machine, "axes", faults);
  else if (machine.coordinates < contour.dimension)
    faults.push_back({{"machine", "axes"}, "need one that moves z: the contour is in space"});
  if (method_row(planning.method).order == 3 && !(planning.along.jerk < unlimited) &&
      !limits_jerk(machine, machine.cartesian() ? contour.dimension : machine.dimension()))
    faults.push_back(
        {jerk_place(machine), "is required by method jerk_limited, of one axis at least that the contour moves"});
  check_setpoints(shortest_time(contour, machine), machine, planning.max_setpoints, faults);
  return faults;
}

}  // namespace bahnwerk
