#pragma once
/// A stage of a job's progress for code that works in small steps: it counts the steps and calls Progress often enough
/// to stop within milliseconds, and seldom enough to cost nothing.
#include <cstddef>
#include <string_view>

#include "core/base/progress.hpp"

namespace bahnwerk {

/// Reports the progress of one stage.
class ProgressScope {
 public:
  /// `stage` is the stage's name and has to outlive this object.
  ProgressScope(Progress progress, std::string_view stage) : progress_(progress), stage_(stage) {}

  /// The following work is the part [begin, end] ⊂ [0, 1] of the stage.
  void part(double begin, double end) {
    begin_ = begin;
    end_ = end;
    fraction_ = 0;
    report();
  }
  /// The following work is half of the rest of the stage: for loops of unknown length, after part().
  void half_of_rest() { part(end_, 0.5 + 0.5 * end_); }
  /// Sets the completed fraction of this part, in [0, 1], without a report.
  void done(double fraction) { fraction_ = fraction; }

  /// Counts `units` of work of roughly 0.1 to 1 µs each.
  void work(std::size_t units = 1) {
    work_ += units;
    if (work_ >= units_per_report) report();
  }
  /// Step i of n of this part begins; a step takes a few hundred nanoseconds.
  void operator()(std::size_t i, std::size_t n) {
    if (i % steps_per_report == 0) report(i, n);
  }
  /// Step i of n of this part begins; a step takes up to a millisecond.
  void now(std::size_t i, std::size_t n) {
    if (i % long_steps_per_report == 0) report(i, n);
  }
  /// Reports at once.
  void report() {
    work_ = 0;
    progress_.report(stage_, begin_ + fraction_ * (end_ - begin_));
  }

 private:
  static constexpr std::size_t units_per_report = 8192, steps_per_report = 1 << 14, long_steps_per_report = 16;
  void report(std::size_t i, std::size_t n) {
    done(static_cast<double>(i) / static_cast<double>(n));
    report();
  }

  Progress progress_;
  std::string_view stage_;
  double begin_ = 0, end_ = 1;  // range of the present part, fractions of the stage
  double fraction_ = 0;         // completed fraction of that part
  std::size_t work_ = 0;
};

}  // namespace bahnwerk
