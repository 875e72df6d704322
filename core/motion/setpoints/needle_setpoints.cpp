#include "core/motion/setpoints/needle_setpoints.hpp"

#include <numbers>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

Machine in_degrees(Machine machine) {
  for (AxisLimits& axis : machine.axes)
    if (axis.unit == "rad") axis.unit = "deg";
  return machine;
}

}  // namespace

NeedleSetpoints::NeedleSetpoints(const std::shared_ptr<const PathMotion>& motion,
                                 std::shared_ptr<const KinematicAxisPath> axes, const Machine& machine,
                                 std::size_t cycles, double brake)
    : MotionSetpoints(motion, in_degrees(machine), cycles),
      motion_(motion),
      axes_(std::move(axes)),
      shown_(shown(machine)),
      brake_(brake) {
  for (const AxisLimits& axis : in_degrees(machine).axes) add_column({"j" + axis.name, axis.unit + "/s³"});
  for (const Column& column : {Column{"x", "mm"},
                               {"y", "mm"},
                               {"z", "mm"},
                               {"phi", "deg"},
                               {"psi", "deg"},
                               {"s", "mm"},
                               {"v", "mm/s"},
                               {"brake", "N"}})
    add_column(column);
}

std::vector<double> NeedleSetpoints::shown(const Machine& machine) {
  std::vector<double> factors;
  for (const AxisLimits& axis : machine.axes) factors.push_back(axis.unit == "rad" ? degrees : 1);
  return factors;
}

void NeedleSetpoints::write(Row& row, double* out) const {
  const std::size_t n = shown_.size();
  std::size_t segment = axes_->size() - 1;
  LawState x{axes_->length(), 0, 0, 0};
  double u = (*axes_)[segment].curve().end();
  if (!row.last) {
    row.piece = motion_->law().find(row.t, row.piece);
    x = motion_->along(row.piece, row.t);
    segment = motion_->law().pieces()[row.piece].segment;
    u = (*axes_)[segment].parameter(x.s);
  }
  const AxisJet q = row.last ? axes_->at_parameter(segment, u) : axes_->at(segment, x.s);
  for (std::size_t k = 0; k < n; ++k) {
    out[k] = shown_[k] * q.value[k];
    out[n + k] = shown_[k] * (q.d1[k] * x.v) + 0.0;  // no -0
    out[2 * n + k] = shown_[k] * (q.d2[k] * (x.v * x.v) + q.d1[k] * x.a);
    out[3 * n + k] = shown_[k] * (q.d3[k] * (x.v * x.v * x.v) + 3 * q.d2[k] * (x.v * x.a) + q.d1[k] * x.j);
  }
  const ToolPose pose = axes_->pose(segment, u);
  out += 4 * n;
  for (const double value :
       {pose.position.x, pose.position.y, pose.position.z, degrees * pose.phi, degrees * pose.psi, x.s, x.v, brake_})
    *out++ = value;
}

}  // namespace bahnwerk
