#include "core/redundant/iterative/kept_knots.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

/// A sample every 0.1 s; block i from begin[i] on, until begin.back().
HeadSamples head(const std::vector<int>& begin) {
  HeadSamples samples;
  for (std::size_t b = 0; b + 1 < begin.size(); ++b)
    for (int i = begin[b]; i < begin[b + 1] + (b + 2 == begin.size() ? 1 : 0); ++i) {
      samples.times.push_back(0.1 * i);
      samples.segments.push_back(7 + b);
    }
  return samples;
}

TimeSpline pieces(const std::vector<double>& ends) {
  TimeSpline spline;
  for (const double end : ends) spline.append(end, {});
  return spline;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12) << i;
}

TEST(KeptKnots, StayWhereTheHeadTakesAsLongAsBefore) {
  const HeadSamples same = head({0, 10, 12, 20});
  KeptKnots knots;
  knots.keep(same, {pieces({0.3, 1.0, 1.15, 1.9, 2}), pieces({2})});
  expect_near(knots.times(same, 0), {0.3, 1.0, 1.15, 1.9});
  EXPECT_TRUE(knots.times(same, 1).empty());
}

TEST(KeptKnots, KeepTheirShareOfABlockThatTakesLonger) {
  KeptKnots knots;
  knots.keep(head({0, 10, 12, 20}), {pieces({0.3, 1.0, 1.15, 1.6, 2})});
  expect_near(knots.times(head({0, 10, 16, 24}), 0), {0.3, 1.0, 1.45, 2.0});
}

/// Blocks shorter than what is between samples.
TEST(KeptKnots, BlocksWithoutASampleTakeNoTime) {
  KeptKnots knots;
  knots.keep(head({0, 10, 12, 20}), {pieces({1.1, 1.6, 2})});
  expect_near(knots.times(head({0, 10, 10, 18}), 0), {1.0, 1.4});
  knots.keep(head({0, 10, 10, 18}), {pieces({1.0, 1.4, 1.8})});
  expect_near(knots.times(head({0, 10, 12, 20}), 0), {1.2, 1.6});
}

}  // namespace
}  // namespace bahnwerk
