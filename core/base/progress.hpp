#pragma once
/// What a planner reports while it works, and how it learns that it has to stop. No planner runs 100 ms without a
/// report. Reporting is cheap; sinks throttle what they publish.
#include <string_view>

namespace bahnwerk {

/// Receives the reports of a job.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// Takes the completed `fraction` of the whole job, in [0, 1]. Throws Stopped (core/base/errors.hpp) when the planner
  /// has to end.
  virtual void report(std::string_view stage, double fraction, std::string_view message = {}) = 0;
};

/// A part of a job's progress, handed on by value: whoever gets it reports fractions of that part.
class Progress {
 public:
  /// Reports nothing and never stops.
  Progress() = default;
  /// The whole of a job. The sink outlives all copies and parts.
  Progress(ProgressSink& sink) : sink_(&sink) {}

  /// Returns the part [from, to] ⊂ [0, 1] of this one.
  Progress part(double from, double to) const {
    Progress result = *this;
    result.from_ = at(from);
    result.to_ = at(to);
    return result;
  }
  /// Returns this part under the name `stage`, which outlives it, whatever names are reported within; an outer name
  /// stands before an inner one.
  Progress named(std::string_view stage) const {
    Progress result = *this;
    if (result.stage_.empty()) result.stage_ = stage;
    return result;
  }
  /// Reports the completed `fraction` of this part, in [0, 1]. Throws Stopped when the planner has to end.
  void report(std::string_view stage, double fraction, std::string_view message = {}) const {
    if (sink_) sink_->report(stage_.empty() ? stage : stage_, at(fraction), message);
  }

 private:
  double at(double fraction) const { return from_ + fraction * (to_ - from_); }

  ProgressSink* sink_ = nullptr;
  double from_ = 0, to_ = 1;  // range of the part, fractions of the job
  std::string_view stage_;    // name of everything reported; empty: the names reported
};

}  // namespace bahnwerk
