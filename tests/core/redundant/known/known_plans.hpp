#pragma once
/// Plans by one method, and what every split has to keep.
#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/redundant/methods/method_table.hpp"
#include "core/redundant/redundancy.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/split_excess.hpp"

namespace bahnwerk::test {

inline constexpr RedundancyMethod known_methods[] = {RedundancyMethod::geometric, RedundancyMethod::filter,
                                                     RedundancyMethod::follow_up, RedundancyMethod::lag_compensation};

inline RedundancyResult plan(const RedundancyTask& task, RedundancyMethod method,
                             const RedundancyOptions& options = {}) {
  Progress progress;
  return found(redundancy_row(method).plan(task, options, progress));
}

inline void expect_valid(const RedundancyTask& task, const RedundancyResult& r) {
  const SplitExcess e = split_excess(task, r);
  EXPECT_LE(e.limits, 1e-4);  // what the plan makes up for
  EXPECT_LE(e.jump, 1e-9);
  EXPECT_LE(e.rest, 1e-6);
  EXPECT_LE(e.time, 1e-12 * r.head->duration());
}

}  // namespace bahnwerk::test
