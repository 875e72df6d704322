#include "core/cam/classical_law.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::cam {
namespace {

TEST(ClassicalLaw, AccelerationJumpsInsideConstantAccelerationAndWithoutACosineAlone) {
  EXPECT_TRUE(acceleration_jumps(ClassicalLaw::quadratic, {}));
  EXPECT_TRUE(acceleration_jumps(ClassicalLaw::sine_straight_combination, {0.3, 0.2, 0}));
  EXPECT_FALSE(acceleration_jumps(ClassicalLaw::sine_straight_combination, {0, 0.4, 0.3}));
  EXPECT_FALSE(acceleration_jumps(ClassicalLaw::modified_sine, {0.3, 0.2, 0}));
}

}  // namespace
}  // namespace bahnwerk::cam
