#include "core/plan/contour/contour_axes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/motion/axes/machine_path.hpp"
#include "core/motion/axes/path_task.hpp"

namespace bahnwerk {
namespace {

constexpr double perpendicular = 1e-14;  // cosine of the angle between two axes that counts as rounding
constexpr double degrees = 180 / std::numbers::pi;

/// Returns the turn of a machine whose axes are perpendicular to each other, one per coordinate.
std::optional<Isometry> turn_of(const LinearMap& map, std::size_t axes, std::size_t coordinates) {
  if (axes != coordinates) return {};
  Isometry turn;
  for (std::size_t k = 0; k < axes; ++k) turn.rows[k] = map.rows[k] / norm(map.rows[k]);
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(dot(turn.rows[k], turn.rows[(k + 1) % 3])) > perpendicular) return {};
  return turn;
}

bool has_range(const Machine& machine) {
  return std::any_of(machine.axes.begin(), machine.axes.end(), [](const AxisLimits& axis) { return axis.has_range(); });
}

}  // namespace

ContourAxes::ContourAxes(const std::shared_ptr<const Contour>& given, const ToolMachine& machine)
    : limits_(machine), moved_(machine.dimension()), coordinates_(machine.coordinates) {
  if (machine.cartesian()) {
    moved_ = std::min(moved_, given->dimension);
    return;
  }
  kinematics_ = machine.configurations.front();
  if (machine.configurations.size() > 1)
    kinematics_ = machine_path(placed(given), nullptr, machine.configurations).kinematics;
  shown_.assign(machine.dimension(), 1);
  for (std::size_t k = 0; k < machine.dimension(); ++k)
    if (limits_.axes[k].unit == "rad") shown_[k] = degrees;
  const LinearMap* const map = kinematics_->linear();
  if (map != nullptr) turn_ = turn_of(*map, machine.dimension(), machine.coordinates);
  if (!turn_) return;
  for (std::size_t k = 0; k < machine.dimension(); ++k) {
    shown_[k] = norm(map->rows[k]);
    AxisLimits& axis = limits_.axes[k];
    for (int order = 1; order <= Limits::highest_order; ++order) axis.of(order) /= shown_[k];
    axis.lowest /= shown_[k], axis.highest /= shown_[k];
  }
  const auto across = [&](std::size_t k) { return turn_->rows[k].x == 0 && turn_->rows[k].y == 0; };
  if (given->dimension < 3)
    while (moved_ > 1 && across(moved_ - 1)) --moved_;
}

double ContourAxes::height(const Contour& contour) const {
  return contour.dimension < 3 && coordinates_ > 2 ? contour.height : 0;
}

std::shared_ptr<const Path> ContourAxes::placed(const std::shared_ptr<const Contour>& contour) const {
  const Vec up{0, 0, height(*contour)};
  if (!turn_ && up.z == 0) return {contour, &contour->path};
  Isometry map = turn_.value_or(Isometry{});
  map.offset = map.turned(up);
  return std::make_shared<const Path>(turned(contour->path, map));
}

ContourAxes::Paths ContourAxes::along(const std::shared_ptr<const Contour>& contour) const {
  if (!kinematics_) return {contour_axes(contour, limits_.dimension()), contour_axes(contour, moved_)};
  if (has_range(limits_)) {
    auto axes = machine_path(turn_ ? std::shared_ptr<const Path>(contour, &contour->path) : placed(contour), nullptr,
                             {kinematics_})
                    .axes;
    if (!turn_) return {axes, axes};
  }
  const std::shared_ptr<const Path> tool = placed(contour);
  if (!turn_) {
    auto axes = std::make_shared<const KinematicAxisPath>(tool, kinematics_);
    return {axes, axes};
  }
  auto all = std::make_shared<const CartesianAxisPath>(tool, limits_.dimension());
  if (moved_ == limits_.dimension()) return {all, all};
  return {all, std::make_shared<const CartesianAxisPath>(tool, moved_)};
}

ToolLimitsMap ContourAxes::tool_limits(const Machine& held) const {
  if (!kinematics_ || turn_) return held;
  return {[kinematics = kinematics_, held, coordinates = coordinates_](Vec at) {
            return bahnwerk::tool_limits(*kinematics, held, coordinates, at);
          },
          held.cycle_time};
}

void show(const ContourAxes& axes, const Machine& machine, Verification& verification) {
  if (axes.shown().empty()) return;
  for (Check& check : verification.checks) {
    double factor = 1;
    if (check.quantity == quantity::axis)
      for (std::size_t k = 0; k < machine.dimension(); ++k)
        if (check.subject == machine.axes[k].name) factor = axes.shown()[k];
    if (check.unit == "rad") check.unit = "deg", factor = degrees;
    check.value *= factor, check.limit *= factor;
  }
}

}  // namespace bahnwerk
