#include "core/motion/setpoints/motion_setpoints.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace bahnwerk {

MotionSetpoints::MotionSetpoints(std::shared_ptr<const Motion> motion, const Machine& machine, std::size_t cycles)
    : motion_(std::move(motion)), cycles_(cycles), cycle_time_(machine.cycle_time) {
  if (motion_->axes() != machine.axes.size())
    throw std::invalid_argument("setpoints need a motion of every axis of the machine");
  for (const auto& [prefix, per] : {std::pair{"", ""}, std::pair{"v", "/s"}, std::pair{"a", "/s²"}})
    for (const AxisLimits& axis : machine.axes) columns_.push_back({prefix + axis.name, axis.unit + per});
}

namespace {
double* written(const MotionState& state, std::size_t axes, double* out) {
  for (std::size_t i = 0; i < axes; ++i) *out++ = state.position[i];
  for (std::size_t i = 0; i < axes; ++i) *out++ = state.velocity[i];
  for (std::size_t i = 0; i < axes; ++i) *out++ = state.acceleration[i];
  return out;
}
}  // namespace

void MotionSetpoints::read(std::size_t first, std::size_t rows, double* out) const {
  const std::size_t axes = motion_->axes(), further = columns_.size() - 3 * axes;
  Row row;
  for (std::size_t k = first; k < first + rows; ++k) {
    row.t = static_cast<double>(k) * cycle_time_;
    row.last = k == cycles_;
    if (row.last)
      out = written(motion_->final_state(), axes, out);
    else
      out = written(state(row), axes, out);
    if (further == 0) continue;
    further_columns(row, out);
    out += further;
  }
}

}  // namespace bahnwerk
