#include "core/redundant/known/filter_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/redundant/known/known_plans.hpp"

namespace bahnwerk {
namespace {

using test::expect_valid, test::plan;

/// [Bock 3.3]: the filter makes the motion longer by twice its group delay, and in that time the head stands.
TEST(KnownMethods, AFilterMakesTheHeadWaitForItsGroupDelayAtBothEnds) {
  const RedundancyTask task = test::redundancy_task(test::holes(2, 2, 12, 2), test::md2());
  RedundancyOptions options;
  for (const std::size_t taps : {31u, 61u}) {
    options.taps = taps;
    const RedundancyResult r = plan(task, RedundancyMethod::filter, options);
    expect_valid(task, r);
    const double delay = 0.001 * static_cast<double>(taps - 1) / 2, T = r.head->duration();
    for (const double at : {0.0, 0.5, 0.99}) {
      EXPECT_EQ(r.head->evaluate(at * delay)[1][0], 0);
      EXPECT_EQ(r.head->evaluate(T - at * delay)[1][0], 0);
    }
    EXPECT_GT(std::abs(r.coarse->evaluate(0.99 * delay)[1][0]), 0);
  }
}

}  // namespace
}  // namespace bahnwerk
