#pragma once
/// The axes of a machine along a contour, for the pipeline: paths of the axes, their limits, and the tool's.
///
/// A Cartesian machine's axes are the coordinates of the contour. A linear machine whose axes are perpendicular to each
/// other (CoreXY, a portal at an angle) is a Cartesian one that stands turned, with axes of another scale: the contour
/// is turned instead, and the limits are divided by the scale. That is exact, and as quick to plan. Any other
/// machine is planned through its kinematics.
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/geometry/path/turned.hpp"
#include "core/machine/tool_limits.hpp"
#include "core/machine/tool_machine.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// Immutable and thread-safe.
class ContourAxes {
 public:
  /// Chooses the configuration of the machine for `given` (core/motion/axes/machine_path.hpp). Throws UnreachablePose
  /// where the machine does not reach it, is singular or leaves an axis' range.
  ContourAxes(const std::shared_ptr<const Contour>& given, const ToolMachine& machine);

  struct Paths {
    std::shared_ptr<const AxisPath> all;
    std::shared_ptr<const AxisPath> moving;  ///< leading axes; the others stand still
  };
  /// Returns the axes along a contour that lies close to the given one. Throws like the constructor.
  Paths along(const std::shared_ptr<const Contour>& contour) const;
  /// Returns the machine whose limits hold for the axes of these paths.
  const Machine& machine() const { return limits_; }
  std::size_t moved() const { return moved_; }  ///< number of axes of Paths::moving
  /// Returns the limits of the tool with those of the first axes of `held`, which are limits of these paths' axes.
  ToolLimitsMap tool_limits(const Machine& held) const;
  /// Returns a factor per axis from the paths' unit to that of setpoints (mm, deg); empty: 1.
  const std::vector<double>& shown() const { return shown_; }
  /// Returns the chosen kinematics; null for a Cartesian machine.
  const std::shared_ptr<const Kinematics>& kinematics() const { return kinematics_; }
  /// Returns the height of a planar contour on the machine: 0 if that has no third coordinate.
  double height(const Contour& contour) const;

 private:
  std::shared_ptr<const Path> placed(const std::shared_ptr<const Contour>& contour) const;

  Machine limits_;
  std::size_t moved_ = 0, coordinates_ = 0;
  std::shared_ptr<const Kinematics> kinematics_;
  std::optional<Isometry> turn_;  ///< the turn of a linear machine with perpendicular axes
  std::vector<double> shown_;
};

/// Converts the checks of a plan from the units of the paths' axes to those of setpoints. A check of several axes at
/// once stays in mm along the axes' directions, unless their unit is rad.
void show(const ContourAxes& axes, const Machine& machine, Verification& verification);

}  // namespace bahnwerk
