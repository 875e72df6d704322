#pragma once
/// Counts small steps of reading and tells Progress often enough, but not at every one.
#include <cstddef>

#include "core/progress.hpp"

namespace bahnwerk {

class ReadingProgress {
 public:
  explicit ReadingProgress(Progress& progress) : progress_(progress) {}

  /// A step takes a microsecond at most: reports come every 16 ms or faster.
  void work(std::size_t steps = 1) {
    if ((done_ += steps) < per_report) return;
    done_ = 0;
    progress_.report("reading", 0);
  }

 private:
  static constexpr std::size_t per_report = 16384;
  Progress& progress_;
  std::size_t done_ = 0;
};

}  // namespace bahnwerk
