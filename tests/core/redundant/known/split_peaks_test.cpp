#include "core/redundant/known/split_peaks.hpp"

#include <gtest/gtest.h>

#include "core/motion/axes/spline_motion.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk {
namespace {

TEST(MotionPeaks, OfEveryPartAreThoseOfItsOwnIntervals) {
  // The head rises by 8 t² for half a second and falls as it rose; the coarse axis goes by 2 mm/s all along.
  const SplineMotion head({{0.5, {Polynomial{0, 0, 8}}}, {1, {Polynomial{2, 8, -8}}}}),
      coarse({{1, {Polynomial{0, 2}}}});
  const auto parts = split_peaks(head, coarse, {0.5}, silent_scope());
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_DOUBLE_EQ(parts[0][0].coarse_velocity, 2);
  EXPECT_DOUBLE_EQ(parts[0][0].coarse_acceleration, 0);
  EXPECT_DOUBLE_EQ(parts[0][0].fine_velocity, 6) << "8 mm/s less the coarse 2, at the border";
  EXPECT_DOUBLE_EQ(parts[0][0].fine_acceleration, 16);
  EXPECT_DOUBLE_EQ(parts[0][0].offset, 1);
  EXPECT_DOUBLE_EQ(parts[1][0].offset, 2.125) << "where both are equally quick";
  const auto whole = split_peaks(head, coarse, silent_scope());
  EXPECT_DOUBLE_EQ(whole[0].offset, 2.125);
}

TEST(MotionPeaks, UseIsTheLargestQuotientOfAPeakAndItsLimit) {
  CoarseFineMachine machine;
  machine.axes = {{"x", {10, 100}, {20, 400}, 5}, {"y", {20, 50}, {10, 800}, 2}};
  std::vector<RedundancyPeaks> peaks(2);
  peaks[0] = {1, 5, 20, 4, 100};
  peaks[1] = {1.5, 4, 20, 3, 80};
  const SplitUse use = use_of(peaks, machine);
  EXPECT_DOUBLE_EQ(use.offset, 0.75);
  EXPECT_DOUBLE_EQ(use.coarse_velocity, 0.5);
  EXPECT_DOUBLE_EQ(use.coarse_acceleration, 0.4);
  EXPECT_DOUBLE_EQ(use.fine_velocity, 0.3);
  EXPECT_DOUBLE_EQ(use.fine_acceleration, 0.25);
  EXPECT_DOUBLE_EQ(use.most(), 0.75);
}

}  // namespace
}  // namespace bahnwerk
