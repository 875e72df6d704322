#pragma once
/// A sink that keeps what was reported last, and stops the planner if it is told to.
#include <string>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::test {

struct LastReport final : ProgressSink {
  void report(std::string_view name, double value, std::string_view text) override {
    stage = name, fraction = value, message = text;
    if (stop) throw Stopped(StopReason::cancelled);
  }
  std::string stage, message;
  double fraction = -1;
  bool stop = false;
};

}  // namespace bahnwerk::test
