#pragma once
#include <algorithm>

#include "core/base/progress.hpp"

namespace bahnwerk {

/// Reports no fraction less than one before, where a job repeats a step.
class OnwardProgress final : public ProgressSink {
 public:
  explicit OnwardProgress(Progress whole) : whole_(whole) {}
  void report(std::string_view stage, double fraction, std::string_view message = {}) override {
    most_ = std::max(most_, fraction);
    whole_.report(stage, most_, message);
  }

 private:
  Progress whole_;
  double most_ = 0;
};

}  // namespace bahnwerk
