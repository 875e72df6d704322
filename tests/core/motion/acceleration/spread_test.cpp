#include "core/motion/acceleration/spread.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/silent_scope.hpp"

namespace bahnwerk {
namespace {

TEST(Spread, EachPartGetsWhatItsCellHad) {
  LargeVector<std::uint8_t> parts{1, 3, 1, 2};
  std::vector<int> values{10, 11, 12, 13};
  spread(values, parts, 7, silent_scope());
  EXPECT_EQ(values, (std::vector<int>{10, 11, 11, 11, 12, 13, 13}));
}

TEST(Spread, ValueOfTheEndStaysTheLast) {
  LargeVector<std::uint8_t> parts{2, 1};
  std::vector<int> values{10, 11, 99};
  spread(values, parts, 3, silent_scope());
  EXPECT_EQ(values, (std::vector<int>{10, 10, 11, 99}));
}

TEST(Spread, NothingDividedChangesNothing) {
  LargeVector<std::uint8_t> parts{1, 1, 1};
  std::vector<int> values{10, 11, 12};
  spread(values, parts, 3, silent_scope());
  EXPECT_EQ(values, (std::vector<int>{10, 11, 12}));
}

}  // namespace
}  // namespace bahnwerk
