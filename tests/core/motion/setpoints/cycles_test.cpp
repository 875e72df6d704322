#include "core/motion/setpoints/cycles.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(Cycles, SlowByLessThanOneCycle) {
  for (const double t : {1e-9, 0.0009999, 0.001, 0.0010001, 7.3936, 0.3, 12345.678}) {
    const Cycles c = whole_cycles(t, 0.001);
    EXPECT_GE(c.factor, 1);
    EXPECT_LT(static_cast<double>(c.count) * 0.001 - t, 0.001 * (1 + 1e-9));
    EXPECT_NEAR(c.factor * t, static_cast<double>(c.count) * 0.001, 1e-12 * t);
  }
  EXPECT_EQ(whole_cycles(7.3936, 0.001).count, 7394u);
}

}  // namespace
}  // namespace bahnwerk
