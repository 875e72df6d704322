#include "core/motion/setpoints/needle_setpoints.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/machine/degrees.hpp"

namespace bahnwerk {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

}  // namespace

NeedleSetpoints::NeedleSetpoints(const std::shared_ptr<const PathMotion>& motion,
                                 std::shared_ptr<const KinematicAxisPath> axes, const Machine& machine, WireForces wire,
                                 Options options)
    : MotionSetpoints(motion, in_degrees(machine), options.cycles),
      motion_(motion),
      axes_(std::move(axes)),
      interpolation_(std::move(options.interpolation)),
      shown_(shown(machine)),
      wire_(std::move(wire)),
      frame_(options.frame) {
  for (const AxisLimits& axis : in_degrees(machine).axes) add_column({"j" + axis.name, axis.unit + "/s³"});
  for (const Column& column : {Column{"x", "mm"},
                               {"y", "mm"},
                               {"z", "mm"},
                               {"phi", "deg"},
                               {"psi", "deg"},
                               {"s", "mm"},
                               {"v", "mm/s"},
                               {"brake", "N"},
                               {"vx", "mm/s"},
                               {"vy", "mm/s"},
                               {"vz", "mm/s"},
                               {"vphi", "deg/s"},
                               {"vpsi", "deg/s"},
                               {"tension", "N"}})
    add_column(column);
}

std::vector<double> NeedleSetpoints::shown(const Machine& machine) {
  std::vector<double> factors;
  for (const AxisLimits& axis : machine.axes) factors.push_back(axis.unit == "rad" ? degrees : 1);
  return factors;
}

NeedleSetpoints::Place NeedleSetpoints::place(Row& row) const {
  if (row.last) {
    const std::size_t segment = axes_->size() - 1;
    return {segment, (*axes_)[segment].curve().end(), {axes_->length(), 0, 0, 0}};
  }
  if (interpolation_) {
    if (row.place == Row::unknown)
      row.stepped = interpolation_->row(row.index), row.place = 0;
    else
      interpolation_->advance(row.stepped);
    LawState law = row.stepped.law;
    law.s = row.stepped.place.s;
    const std::size_t segment = row.stepped.place.segment;
    return {segment, (*axes_)[segment].parameter(law.s), law};  // the place that follows from column s
  }
  row.piece = motion_->law().find(row.t, row.piece);
  const LawState law = motion_->along(row.piece, row.t);
  const std::size_t segment = motion_->law().pieces()[row.piece].segment;
  return {segment, (*axes_)[segment].parameter(law.s), law};
}

void NeedleSetpoints::write(Row& row, double* out) const {
  const std::size_t n = shown_.size();
  const auto [segment, u, x] = place(row);
  const AxisJet q = row.last ? axes_->at_parameter(segment, u) : axes_->at(segment, x.s);
  for (std::size_t k = 0; k < n; ++k) {
    out[k] = shown_[k] * q.value[k];
    out[n + k] = shown_[k] * (q.d1[k] * x.v) + 0.0;  // the sum contains no −0
    out[2 * n + k] = shown_[k] * (q.d2[k] * (x.v * x.v) + q.d1[k] * x.a);
    out[3 * n + k] = shown_[k] * (q.d3[k] * (x.v * x.v * x.v) + 3 * q.d2[k] * (x.v * x.a) + q.d1[k] * x.j);
  }
  const ToolJet tool = axes_->tool_jet(segment, u);
  out += 4 * n;
  const Vec &at = tool.position.value, &along = tool.position.d1;
  for (const double value :
       {at.x, at.y, at.z, degrees * tool.phi.value, degrees * tool.psi.value, x.s, x.v, wire_.brake(segment, u, x),
        x.v * along.x, x.v * along.y, x.v * along.z, degrees * x.v * tool.phi.d1, degrees * x.v * tool.psi.d1,
        wire_.tension(std::max(0.0, row.t - cycle_time()), row.t)})
    *out++ = value + 0.0;
}

}  // namespace bahnwerk
