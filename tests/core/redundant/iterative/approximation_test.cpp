#include "core/redundant/iterative/approximation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/redundant/iterative/coarse_tasks.hpp"

namespace bahnwerk {
namespace {

using test::task_of;

TEST(CoarseFit, PassesGrowWithTheLogarithmOfTheDuration) {
  CoarseFitOptions o;
  o.smoothing = CoarseSmoothing::none;
  int passes = 0;
  o.tick = [&] { ++passes; };
  std::vector<int> counts;
  for (const double duration : {4.0, 40.0, 400.0}) {
    passes = 0;
    const auto n = static_cast<std::size_t>(500 * duration) + 1;
    const CoarseTask task = task_of(duration, n, 2, [](double t) { return 30 * std::sin(7 * t) * std::sin(t); });
    const std::optional<Approximation> found = approximate(task, o);
    ASSERT_TRUE(found);
    EXPECT_LE(found->rows.largest_error(task, found->variables), task.tolerance);
    counts.push_back(passes);
  }
  EXPECT_LE(counts[2] - counts[1], counts[1] - counts[0] + 10) << counts[0] << ' ' << counts[1] << ' ' << counts[2];
}

}  // namespace
}  // namespace bahnwerk
