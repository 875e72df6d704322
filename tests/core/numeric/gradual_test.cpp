// How far parts of a step may differ from one place to the next.
#include "core/numeric/gradual.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(NextPart, GrowsByAFactorWhereSmallAndByASumWhereLarge) {
  EXPECT_DOUBLE_EQ(next_part(0.01), 0.0105);
  EXPECT_DOUBLE_EQ(next_part(0.8), 0.82);
  EXPECT_EQ(next_part(0.0), 0);
}

TEST(NextPart, IsComputedLaneByLane) {
  const Lanes<2> next = next_part(Lanes<2>{0.01, 0.8});
  EXPECT_EQ(next[0], next_part(0.01));
  EXPECT_EQ(next[1], next_part(0.8));
}

}  // namespace
}  // namespace bahnwerk
