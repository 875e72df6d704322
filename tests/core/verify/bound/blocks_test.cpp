#include "core/verify/bound/blocks.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace bahnwerk::verify {
namespace {

TEST(Blocks, ElementsDoNotMoveWhileMoreAreAdded) {
  Blocks<int> numbers;
  numbers.push_back(7);
  const int* const first = &numbers[0];
  for (int i = 1; i < 100'000; ++i) numbers.push_back(i);
  EXPECT_EQ(first, &numbers[0]);
  EXPECT_EQ(numbers[0], 7);
  EXPECT_EQ(numbers[99'999], 99'999);
}

TEST(Blocks, AnOrderedViewFollowsItsIndices) {
  Blocks<int> numbers;
  for (int i = 0; i < 2000; ++i) numbers.push_back(10 * i);
  const std::vector<std::uint32_t> order{1999, 3, 700};
  const Ordered<int, std::uint32_t> view(numbers, order.data(), order.size());
  EXPECT_EQ(view.size(), 3u);
  EXPECT_EQ(view.front(), 19990);
  EXPECT_EQ(view[1], 30);
  EXPECT_EQ(view.back(), 7000);
  std::vector<int> seen;
  for (const int number : view) seen.push_back(number);
  EXPECT_EQ(seen, (std::vector<int>{19990, 30, 7000}));
}

}  // namespace
}  // namespace bahnwerk::verify
