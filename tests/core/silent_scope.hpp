#pragma once
/// For tests that are not about progress.
#include "core/base/progress_scope.hpp"

namespace bahnwerk {

/// Reports to nobody and never stops.
inline ProgressScope& silent_scope() {
  static Progress progress;
  static ProgressScope stage_progress(progress, "test");
  return stage_progress;
}

}  // namespace bahnwerk
