#include "core/redundant/iterative/adaptive_split.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/redundant/iterative/iterative.hpp"
#include "core/redundant/methods/reversed_task.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/iterative/iterative_plans.hpp"

namespace bahnwerk {
namespace {

using test::expect_valid_split, test::plan_by_iterations;

/// What is exceeded by a little slows the whole motion by as little, and is valid as it is.
TEST(Iterative, SlowsALittleInPlaceOfFurtherIterations) {
  Random random(5);
  Progress progress;
  IterativeOptions never_slowed;
  never_slowed.most_slowing = 0;
  int fewer = 0;
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    const RedundancyTask task = test::redundancy_task(test::random_contour(random, 100), test::md2());
    const RedundancyResult slowed = plan_by_iterations(task, {}),
                           exact = test::found(plan_iterative(task, {}, never_slowed, progress));
    expect_valid_split(task, slowed);
    ASSERT_LE(slowed.iterations, exact.iterations);
    if (slowed.iterations == exact.iterations) continue;
    ++fewer;
    // All passes are the same but the last one, which is slowed by what it exceeded.
    const std::size_t last = slowed.iterations - 1;
    for (std::size_t k = 0; k < last; ++k) {
      EXPECT_EQ(slowed.passes[k].duration, exact.passes[k].duration) << k;
      EXPECT_EQ(slowed.passes[k].violated_blocks, exact.passes[k].violated_blocks) << k;
    }
    EXPECT_GT(slowed.passes[last].duration, exact.passes[last].duration);
    EXPECT_LE(slowed.passes[last].duration, (1 + IterativeOptions().most_slowing) * exact.passes[last].duration);
    EXPECT_NEAR(slowed.head->duration(), slowed.passes[last].duration, 1e-12);
    EXPECT_EQ(slowed.passes[last].violated_blocks, 0u);
    EXPECT_GT(exact.passes[last].violated_blocks, 0u);
  }
  EXPECT_GE(fewer, 2);
}

/// Returns the duration of the quicker one of the plans forwards and from the end to the begin.
double in_either_direction(const RedundancyTask& task, const RedundancyOptions& o, const IterativeOptions& constants) {
  Progress progress;
  const RedundancyTask back = reversed(task).value();
  return std::min(test::found(plan_iterative(task, o, constants, progress)).head->duration(),
                  test::found(plan_iterative(back, o, constants, progress)).head->duration());
}

/// With knots anew in each pass and no grading other blocks exceed limits in each.
TEST(Iterative, KeptKnotsEndShorterThanKnotsAnew) {
  Random random(11);
  IterativeOptions new_knots;
  new_knots.iterations_with_new_knots = new_knots.max_iterations;
  new_knots.grading = 0;
  RedundancyOptions o;
  o.smoothing = CoarseSmoothing::none;
  for (int i = 0; i < 2; ++i) {
    SCOPED_TRACE(i);
    const RedundancyTask task = test::redundancy_task(test::random_contour(random, 400), test::md2());
    const RedundancyResult r = plan_by_iterations(task, o);
    expect_valid_split(task, r);
    EXPECT_GT(r.iterations, 3u);
    EXPECT_LT(in_either_direction(task, o, {}), 0.997 * in_either_direction(task, o, new_knots));
  }
}

/// With a second phase, and with other approximations, knots are always anew.
TEST(Iterative, OnlyLeastSquaresAloneKeepsKnots) {
  Random random(4);
  Progress progress;
  IterativeOptions other;
  other.iterations_with_new_knots = 1;
  other.grading = 2;
  const RedundancyTask task = test::redundancy_task(test::random_contour(random, 100), test::md2());
  RedundancyOptions o;
  for (const auto& [approximation, smoothing] :
       {std::pair{CoarseApproximation::least_squares, CoarseSmoothing::quadratic_program},
        {CoarseApproximation::schoenberg, CoarseSmoothing::none},
        {CoarseApproximation::chebyshev, CoarseSmoothing::none}}) {
    o.approximation = approximation;
    o.smoothing = smoothing;
    const RedundancyResult a = plan_by_iterations(task, o), b = test::found(plan_iterative(task, o, other, progress));
    EXPECT_EQ(a.head->duration(), b.head->duration());
    EXPECT_EQ(a.iterations, b.iterations);
  }
}

}  // namespace
}  // namespace bahnwerk
