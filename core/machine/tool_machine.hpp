#pragma once
/// A machine that moves a tool along a contour: limits per axis, and the map from the tool to the axes.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/machine/kinematics.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

/// The limits are those of `axes`, in the axes' units; kinematics add positions, ranges and periods.
struct ToolMachine : Machine {
  /// A Cartesian machine: axis k is coordinate k of the tool.
  ToolMachine(Machine cartesian = {}) : Machine(std::move(cartesian)), coordinates(axes.size()) {}  // NOLINT: implicit
  /// A machine with one or several configurations (the two sides of an elbow), whose axes are equal. It moves the first
  /// `moved` coordinates of the tool.
  ToolMachine(std::vector<std::shared_ptr<const Kinematics>> all, double cycle, std::size_t moved)
      : Machine{all.front()->axes(), cycle}, coordinates(moved), configurations(std::move(all)) {}

  std::size_t coordinates = 0;  ///< number of coordinates x, y, z that the machine moves
  std::vector<std::shared_ptr<const Kinematics>> configurations;  ///< empty: Cartesian
  bool cartesian() const { return configurations.empty(); }
};

}  // namespace bahnwerk
