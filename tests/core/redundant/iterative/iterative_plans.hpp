#pragma once
/// Plans by the iterative method, and what each of them has to keep.
#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/redundant/iterative/iterative.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/split_excess.hpp"

namespace bahnwerk::test {

inline RedundancyResult plan_by_iterations(const RedundancyTask& task, const RedundancyOptions& options) {
  Progress progress;
  return found(plan_iterative(task, options, progress));
}

inline void expect_valid_split(const RedundancyTask& task, const RedundancyResult& r) {
  const SplitExcess e = split_excess(task, r);
  EXPECT_LE(e.limits, 1e-8);
  EXPECT_LE(e.jump, 1e-8);
  EXPECT_LE(e.rest, 1e-7);
  EXPECT_LE(e.time, 1e-12);
}

}  // namespace bahnwerk::test
