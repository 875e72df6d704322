#include "core/motion/setpoints/motion_setpoints.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace bahnwerk {

MotionSetpoints::MotionSetpoints(std::shared_ptr<const Motion> motion, const Machine& machine, std::size_t cycles,
                                 int highest)
    : motion_(std::move(motion)),
      cycles_(cycles),
      orders_(static_cast<std::size_t>(highest) + 1),
      cycle_time_(machine.cycle_time) {
  static constexpr std::array prefix{"", "v", "a", "j", "s"}, per{"", "/s", "/s²", "/s³", "/s⁴"};
  if (highest < 0 || highest > motion_->highest_order())
    throw std::invalid_argument("setpoints have the derivatives that the motion has, up to the snap");
  if (motion_->axes() != machine.axes.size())
    throw std::invalid_argument("setpoints need a motion of every axis of the machine");
  for (std::size_t order = 0; order < orders_; ++order)
    for (const AxisLimits& axis : machine.axes) columns_.push_back({prefix[order] + axis.name, axis.unit + per[order]});
}

namespace {
void write_state(const MotionState& state, std::size_t axes, std::size_t orders, double* out) {
  for (std::size_t order = 0; order < orders; ++order)
    for (std::size_t i = 0; i < axes; ++i) *out++ = state[order][i];
}
}  // namespace

void MotionSetpoints::write(Row& row, double* out) const {
  row.last ? write_end(out) : write_state(motion_->evaluate(row.t, row.piece), motion_->axes(), orders_, out);
}

void MotionSetpoints::write_end(double* out) const {
  write_state(motion_->final_state(), motion_->axes(), orders_, out);
}

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
