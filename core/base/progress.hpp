#pragma once
/// Interface between a planner and its caller: the planner reports its stage and learns whether it has to stop. No
/// planner runs 100 ms without a call. Reporting is cheap; implementations throttle what they publish.
#include <string_view>

namespace bahnwerk {

/// Receives the reports of a planner.
class Progress {
 public:
  virtual ~Progress() = default;
  /// Reports the completed `fraction` of the whole job, in [0, 1]. Throws Stopped (core/base/errors.hpp) when the
  /// planner has to end.
  virtual void report(std::string_view stage, double fraction, std::string_view message = {}) = 0;
};

/// Ignores all reports and never stops.
class SilentProgress final : public Progress {
 public:
  void report(std::string_view, double, std::string_view) override {}
};

}  // namespace bahnwerk
