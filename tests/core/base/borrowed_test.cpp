#include "core/base/borrowed.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(Borrowed, PointsToTheObjectAndOwnsNothing) {
  const int number = 7;
  {
    const std::shared_ptr<const int> pointer = borrowed(number);
    EXPECT_EQ(pointer.get(), &number);
    EXPECT_EQ(pointer.use_count(), 0);
  }
  EXPECT_EQ(number, 7);
}

}  // namespace
}  // namespace bahnwerk
