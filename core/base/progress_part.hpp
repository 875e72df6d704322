#pragma once
/// A share of a job's progress, for a planner that is one of several, and progress of steps that are repeated.
#include <algorithm>
#include <string>
#include <utility>

#include "core/base/progress.hpp"

namespace bahnwerk {

/// Maps a planner's fraction to [from, to] of the whole job, under one stage name.
class ProgressPart final : public Progress {
 public:
  ProgressPart(Progress& whole, std::string stage, double from, double to)
      : whole_(whole), stage_(std::move(stage)), from_(from), to_(to) {}
  void report(std::string_view, double fraction, std::string_view message = {}) override {
    whole_.report(stage_, from_ + (to_ - from_) * fraction, message);
  }

 private:
  Progress& whole_;
  std::string stage_;
  double from_, to_;
};

/// Reports no fraction less than one before, where a job repeats a step.
class OnwardProgress final : public Progress {
 public:
  explicit OnwardProgress(Progress& whole) : whole_(whole) {}
  void report(std::string_view stage, double fraction, std::string_view message = {}) override {
    most_ = std::max(most_, fraction);
    whole_.report(stage, most_, message);
  }

 private:
  Progress& whole_;
  double most_ = 0;
};

}  // namespace bahnwerk
