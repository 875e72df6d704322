#include "core/motion/law/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/law/block_times.hpp"

namespace bahnwerk {

State Trajectory::sample(double t, std::size_t& piece) const {
  piece = law_.find(t, piece);
  const LawPiece& p = law_.pieces()[piece];
  LawState law = p.at(std::clamp(t - p.t0, 0.0, p.duration));
  law.s = std::clamp(law.s, p.s, p.s_end);
  const PathPoint h = contour_->path[p.segment].at(law.s);
  State state;
  state.path = law;
  state.position = h.value;
  state.velocity = law.v * h.d1;
  state.acceleration = law.v * law.v * h.d2 + law.a * h.d1;
  state.jerk = law.v * law.v * law.v * h.d3 + 3 * law.v * law.a * h.d2 + law.j * h.d1;
  return state;
}

Cycles whole_cycles(double duration, double cycle_time) {
  Cycles cycles;
  cycles.count = static_cast<std::size_t>(std::max(1.0, std::ceil(duration / cycle_time)));
  // Division rounds; the motion may only ever be slowed.
  if (static_cast<double>(cycles.count) * cycle_time < duration) ++cycles.count;
  cycles.factor = static_cast<double>(cycles.count) * cycle_time / duration;
  return cycles;
}

CartesianSetpoints::CartesianSetpoints(std::shared_ptr<const Trajectory> trajectory, const Machine& machine,
                                       std::size_t cycles)
    : trajectory_(std::move(trajectory)),
      cycles_(cycles),
      dimension_(machine.dimension()),
      cycle_time_(machine.cycle_time) {
  for (const auto& [prefix, unit] : {std::pair{"", "mm"}, std::pair{"v", "mm/s"}, std::pair{"a", "mm/s²"}})
    for (const AxisLimits& axis : machine.axes) columns_.push_back({prefix + axis.name, unit});
  columns_.push_back({"s", "mm"});
  columns_.push_back({"v", "mm/s"});
  columns_.push_back({"mode", "1"});
  columns_.push_back({"block", "1"});
  const Contour& contour = trajectory_->contour();
  const std::vector<BlockTime> times = block_times(contour, trajectory_->law());
  for (std::size_t b = 0; b < times.size(); ++b)
    if (times[b].end > times[b].begin || contour.blocks[b].last > contour.blocks[b].first)
      labels_.push_back({times[b].begin, b, contour.blocks[b].mode == Mode::cut});
  if (labels_.empty()) labels_.push_back({0, 0, true});
}

void CartesianSetpoints::read(std::size_t first, std::size_t rows, double* out) const {
  const double begin = static_cast<double>(first) * cycle_time_;
  std::size_t piece = trajectory_->law().find(begin);
  const auto later = std::upper_bound(labels_.begin(), labels_.end(), begin,
                                      [](double t, const Label& label) { return t < label.begin; });
  const Label* label = &labels_[later == labels_.begin() ? 0 : static_cast<std::size_t>(later - labels_.begin()) - 1];
  const Label* const last_label = &labels_.back();
  for (std::size_t row = first; row < first + rows; ++row) {
    const double t = static_cast<double>(row) * cycle_time_;
    State state = trajectory_->sample(t, piece);
    while (label != last_label && label[1].begin <= t) ++label;
    if (row == cycles_) {  // arrived: at rest, exactly at the end of the path
      const Segment& last = trajectory_->contour().path[trajectory_->contour().path.size() - 1];
      state = {};
      state.position = last.at_parameter(last.curve().end()).value;
      state.path.s = last.s1();
    }
    if (const Contour& contour = trajectory_->contour(); contour.dimension < 3) state.position.z = contour.height;
    for (std::size_t k = 0; k < dimension_; ++k) *out++ = state.position[k];
    for (std::size_t k = 0; k < dimension_; ++k) *out++ = state.velocity[k];
    for (std::size_t k = 0; k < dimension_; ++k) *out++ = state.acceleration[k];
    *out++ = state.path.s;
    *out++ = state.path.v;
    *out++ = label->cut ? 1 : 0;
    *out++ = static_cast<double>(label->block);
  }
}

}  // namespace bahnwerk
