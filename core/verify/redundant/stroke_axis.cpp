#include "core/verify/redundant/stroke_axis.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::verify {
namespace {

constexpr double nodes_per_unit = 6;  // nodes per unit of time
constexpr double settled = 4;         // units beyond a stop from full speed
constexpr std::size_t most_nodes = 4000;
// Units of time. Over a longer time acceleration limits alone do not restrict the states any more, and rounding would
// count.
constexpr double together = 20;

}  // namespace

StrokeAxis::StrokeAxis(const AxisLimits& coarse, const AxisLimits& fine, std::size_t index, double origin)
    : index_(index),
      stroke_(fine.highest),
      time_(std::sqrt(fine.highest / coarse.acceleration)),
      velocity_(coarse.velocity * time_ / stroke_),
      fine_velocity_(fine.velocity * time_ / stroke_),
      fine_acceleration_(fine.acceleration / coarse.acceleration),
      at_rest_(std::min(velocity_, fine_velocity_)),
      origin_(origin),
      lowest_((coarse.lowest - origin) / stroke_),
      highest_((coarse.highest - origin) / stroke_) {}

double StrokeAxis::horizon() const { return (velocity_ + settled) * time_; }

ReachableStates StrokeAxis::before(const HeadReach& reach, bool rests) const {
  const double until = std::min(horizon(), reach.until) / time_;
  const auto n = static_cast<std::size_t>(std::max(until * nodes_per_unit * (1 - 1e-6), 0.0));
  const std::vector<AxisReach> boxes = reach_at(reach, index_, time_ / nodes_per_unit, n);
  if (rests) return box(boxes[0], 0);
  ReachableStates states = box(boxes[n], n == 0 ? at_rest_ : velocity_);
  for (std::size_t i = n; i-- > 0;) {
    states.advance(1 / nodes_per_unit, velocity_);
    limit(states, boxes[i], i == 0 ? at_rest_ : velocity_);
  }
  return states;
}

ReachableStates StrokeAxis::pass(const ReachableStates& begin, const Passage& passage, double duration) const {
  const auto n = static_cast<std::size_t>(
      std::clamp(std::ceil(duration / time_ * nodes_per_unit), 8.0, static_cast<double>(most_nodes)));
  const double spacing = duration / static_cast<double>(n), h = spacing / time_;
  const double first = (passage.begin.value[index_] - origin_) / stroke_,
               last = (passage.end.value[index_] - origin_) / stroke_;
  const std::vector<AxisReach> from = reach_at(passage.forward, index_, spacing, n),
                               to = reach_at(passage.backward, index_, spacing, n);
  // Limits of the coarse axis; limits of the fine one, whose position is the head's less the coarse one's; largest
  // change that both accelerations permit together.
  ReachableStates coarse = begin, fine = begin.subtracted_from(first), free = begin;
  const bool both_count = duration < together * time_;
  ReachableStates by_coarse = ReachableStates::box(0, 0, 0), by_fine = by_coarse;
  for (std::size_t i = 0; i <= n; ++i) {
    if (i > 0) {
      coarse.advance(h, velocity_);
      fine.advance(h, fine_velocity_, fine_acceleration_);
    }
    if (i > 0 && both_count) {
      by_coarse.advance(h, unlimited);
      by_fine.advance(h, unlimited, fine_acceleration_);
      free.coast(h);
    }
    const bool rests = i == 0 || i == n;
    const AxisReach both{std::max(from[i].lowest, to[n - i].lowest), std::min(from[i].highest, to[n - i].highest)};
    limit(coarse, both, rests ? at_rest_ : velocity_);
    fine.limit(-1, 1, rests ? at_rest_ : fine_velocity_);
    if (coarse.empty() || fine.empty()) return {};
  }
  coarse.limit(fine.subtracted_from(last));
  if (both_count) {
    by_coarse.limit(by_fine.subtracted_from(last - first));  // together they bring the head from rest to rest
    coarse.limit(free.plus(by_coarse));
  }
  return coarse;
}

double StrokeAxis::low(const AxisReach& r) const { return std::max((r.lowest - origin_) / stroke_ - 1, lowest_); }
double StrokeAxis::high(const AxisReach& r) const { return std::min((r.highest - origin_) / stroke_ + 1, highest_); }
ReachableStates StrokeAxis::box(const AxisReach& r, double velocity) const {
  return ReachableStates::box(low(r), high(r), velocity);
}
void StrokeAxis::limit(ReachableStates& states, const AxisReach& r, double velocity) const {
  states.limit(low(r), high(r), velocity);
}

}  // namespace bahnwerk::verify
