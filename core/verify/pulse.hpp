#pragma once
/// Calls progress every so much work, a few ms, so that inner loops can count instead of asking.
#include <cstddef>
#include <string_view>

#include "core/progress.hpp"

namespace bahnwerk::verify {

class Pulse {
 public:
  /// Reports fractions between `from` and `to` of the whole job.
  Pulse(Progress& progress, std::string_view stage, double from, double to)
      : progress_(progress), stage_(stage), from_(from), to_(to) {}

  /// How much of this stage is done, in [0,1].
  void done(double fraction) { fraction_ = fraction; }
  /// `units` of roughly 0.1 to 1 µs have been worked.
  void work(std::size_t units) {
    work_ += units;
    if (work_ >= 8192) report();
  }
  void report() {
    work_ = 0;
    progress_.report(stage_, from_ + fraction_ * (to_ - from_));
  }

 private:
  Progress& progress_;
  std::string_view stage_;
  double from_, to_, fraction_ = 0;
  std::size_t work_ = 0;
};

}  // namespace bahnwerk::verify
