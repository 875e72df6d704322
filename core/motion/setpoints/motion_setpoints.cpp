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
void write_state(const MotionState& state, std::size_t axes, double* out) {
  for (const AxisArray* row : {&state.position, &state.velocity, &state.acceleration})
    for (std::size_t i = 0; i < axes; ++i) *out++ = (*row)[i];
}
}  // namespace

void MotionSetpoints::write(Row& row, double* out) const {
  row.last ? write_end(out) : write_state(motion_->evaluate(row.t, row.piece), motion_->axes(), out);
}

void MotionSetpoints::write_end(double* out) const { write_state(motion_->final_state(), motion_->axes(), out); }

void MotionSetpoints::read(std::size_t first, std::size_t rows, double* out) const {
  const std::size_t width = columns_.size();
  Row row;
  for (std::size_t k = first; k < first + rows; ++k, out += width) {
    row.index = k;
    row.t = static_cast<double>(k) * cycle_time_;
    row.last = k == cycles_;
    write(row, out);
  }
}

}  // namespace bahnwerk
