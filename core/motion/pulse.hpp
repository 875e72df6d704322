#pragma once
/// Turns loops over cells into calls of Progress: often enough to stop within milliseconds, seldom enough to cost
/// nothing.
#include <cstddef>

#include "core/progress.hpp"

namespace bahnwerk {

class PlanningPulse {
 public:
  PlanningPulse(Progress& progress, double from, double to) : progress_(progress), from_(from), to_(to) {}
  /// What follows is this part, [begin, end] ⊂ [0, 1], of the share of progress given above.
  void part(double begin, double end) {
    begin_ = from_ + begin * (to_ - from_);
    end_ = from_ + end * (to_ - from_);
    progress_.report("planning", begin_);
  }
  /// Half of what is left: for loops whose number is not known before.
  void half_of_rest() { part(end_fraction(), 0.5 + 0.5 * end_fraction()); }
  /// Cell i of n is due; a few hundred nanoseconds each.
  void operator()(std::size_t i, std::size_t n) {
    if (i % cells == 0) report(i, n);
  }
  /// Segment i of n is due; up to a millisecond each.
  void now(std::size_t i, std::size_t n) {
    if (i % segments == 0) report(i, n);
  }

 private:
  static constexpr std::size_t cells = 1 << 14, segments = 16;
  void report(std::size_t i, std::size_t n) {
    progress_.report("planning", begin_ + (end_ - begin_) * static_cast<double>(i) / static_cast<double>(n));
  }
  double end_fraction() const { return to_ > from_ ? (end_ - from_) / (to_ - from_) : 1; }
  Progress& progress_;
  double from_, to_;
  double begin_ = 0, end_ = 0;
};

}  // namespace bahnwerk
