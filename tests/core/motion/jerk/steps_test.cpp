#include "core/motion/jerk/steps.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

/// Six cells in both halves, of which one lets only a quarter of the step be taken.
JerkSteps one_tight(std::size_t cell) {
  JerkSteps steps;
  steps.still(3);
  for (std::size_t c = 0; c < 3; ++c) steps.primal[c] = steps.dual[c] = Lane2{0.5, 0.5};  // twice the step would fit
  steps.primal[cell][0] = 4;
  return steps;
}

TEST(JerkSteps, EvenStepsAreTheSmallestOneEverywhere) {
  JerkSteps steps = one_tight(1);
  steps.fit(0.9, true, false);
  for (const Lane2 part : steps.primal) EXPECT_EQ(largest(part), 0.9 / 4);
  EXPECT_EQ(steps.mean_primal, 0.9 / 4);
  EXPECT_EQ(steps.node_primal.size(), 4u);
}

TEST(JerkSteps, UnevenStepsReachNoBoundaryAndRiseGradually) {
  for (std::size_t cell = 0; cell < 3; ++cell) {
    JerkSteps steps = one_tight(cell);
    steps.fit(0.9, false, false);
    EXPECT_LE(steps.primal[cell][0], 0.9 / 4);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t half = 0; half < 2; ++half) {
        EXPECT_GT(steps.primal[c][half], 0);
        EXPECT_LE(steps.primal[c][half], 1);
        if (c > 0) {
          EXPECT_LE(steps.primal[c][half], next_part(steps.primal[c - 1][half]) * (1 + 1e-15));
          EXPECT_LE(steps.primal[c - 1][half], next_part(steps.primal[c][half]) * (1 + 1e-15));
          EXPECT_EQ(steps.node_primal[c][half], std::min(steps.primal[c - 1][half], steps.primal[c][half]));
        }
      }
    // Both halves meet in the middle: the sweep crosses it.
    EXPECT_LE(steps.primal[2][1], next_part(steps.primal[2][0]) * (1 + 1e-15));
    EXPECT_LE(steps.mean_primal, 1);
  }
}

TEST(JerkSteps, WhereNothingIsTightTheWholeStepIsTaken) {
  JerkSteps steps;
  steps.still(2);
  steps.fit(0.9, false, true);
  EXPECT_EQ(steps.mean_primal, 1);
  EXPECT_EQ(steps.mean_dual, 1);
}

}  // namespace
}  // namespace bahnwerk
