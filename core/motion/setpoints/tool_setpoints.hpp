#pragma once
/// The setpoints of a machine whose axes follow a contour through kinematics: axes and tool.
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/motion/setpoints/contour_setpoints.hpp"

namespace bahnwerk {

/// How setpoints show axes and tool.
struct ToolColumns {
  std::vector<double> factors;  ///< per axis, from the motion's unit to that of the columns
  std::size_t coordinates = 3;  ///< number of columns x, y, z
  double height = 0;            ///< z of a planar contour, mm
};

/// The columns are those of ContourSetpoints, rotary axes in deg, deg/s, deg/s², then x, y, z (mm): the tool's place on
/// the contour. A coordinate after which an axis is named has no other column.
class ToolSetpoints final : public ContourSetpoints {
 public:
  /// `motion` follows `contour`, whose limits are those of `machine`, and lasts `cycles` whole cycles.
  ToolSetpoints(const std::shared_ptr<const PathMotion>& motion, std::shared_ptr<const Contour> contour,
                const Machine& machine, std::size_t cycles, ToolColumns columns);

 private:
  void write(Row& row, double* out) const override;

  std::shared_ptr<const PathMotion> motion_;
  std::shared_ptr<const Contour> contour_;
  ToolColumns shown_;
  std::vector<std::size_t> coordinates_;  ///< coordinates that have a column
};

}  // namespace bahnwerk
