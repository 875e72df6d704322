#include "core/base/expected.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace bahnwerk {
namespace {

enum class Why { late, early };

TEST(Expected, HasAValueOrAReason) {
  const Expected<double, Why> value = 2.5, none = Why::early;
  ASSERT_TRUE(value);
  EXPECT_EQ(*value, 2.5);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.reason(), Why::early);
}

/// A value that is false or null is one all the same.
TEST(Expected, AValueOfFalseIsAValue) {
  const Expected<bool, Why> value = false;
  ASSERT_TRUE(value);
  EXPECT_FALSE(*value);
}

TEST(Expected, MovesItsValueOut) {
  Expected<std::unique_ptr<int>, Why> value = std::make_unique<int>(7);
  const std::unique_ptr<int> taken = *std::move(value);
  EXPECT_EQ(*taken, 7);
}

}  // namespace
}  // namespace bahnwerk
