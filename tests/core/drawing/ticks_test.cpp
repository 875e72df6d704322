#include "core/drawing/ticks.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace bahnwerk::drawing {
namespace {

TEST(Ticks, DistanceIsTheNextOfOneTwoFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(nice(0.7), 1);
  EXPECT_DOUBLE_EQ(nice(1.1), 2);
  EXPECT_DOUBLE_EQ(nice(2.1), 5);
  EXPECT_DOUBLE_EQ(nice(5.1), 10);
  EXPECT_DOUBLE_EQ(nice(0.03), 0.05);
  EXPECT_DOUBLE_EQ(nice(1234), 2000);
  EXPECT_DOUBLE_EQ(nice(0.2), 0.2);
}

TEST(Ticks, StandAtEveryMultipleWithBothEnds) {
  std::vector<double> at;
  for_each_tick(-0.2, 0.3, 0.1, [&](double value) { at.push_back(value); });
  ASSERT_EQ(at.size(), 6u);  // neither end is lost to rounding
  for (std::size_t k = 0; k < at.size(); ++k) EXPECT_NEAR(at[k], -0.2 + 0.1 * static_cast<double>(k), 1e-15);
}

TEST(Ticks, LabelsAreShortAndZeroIsZero) {
  EXPECT_EQ(tick_label(0.1 + 0.2), "0.3");
  EXPECT_EQ(tick_label(-1e-17), "0");
  EXPECT_EQ(tick_label(-2500), "-2500");
}

TEST(Ticks, LabelsOfTicksFarFromZeroDiffer) {
  EXPECT_EQ(tick_label(123456789.1, 0.1), "123456789.1");
  EXPECT_NE(tick_label(1e9 + 0.01, 0.01), tick_label(1e9 + 0.02, 0.01));
  EXPECT_EQ(tick_label(0.3, 0.1), "0.3");
}

}  // namespace
}  // namespace bahnwerk::drawing
