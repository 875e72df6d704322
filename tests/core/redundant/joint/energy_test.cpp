#include "core/redundant/joint/energy.hpp"

#include <gtest/gtest.h>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {
namespace {

/// a = 6 + 12 t + 12 t² on [0, 1], then 4 on [1, 3]: ∫a² = 36 + 72 + 96 + 72 + 28.8, then 32.
TEST(Energy, IsTheIntegralOfTheSquaredAcceleration) {
  const SplineMotion motion({{1, {{0, 0, 3, 2, 1}, {0}}}, {3, {{5, 1, 2}, {0, 0, 1}}}});
  const std::vector<double> energy = acceleration_energy(motion);
  EXPECT_NEAR(energy[0], 304.8 + 32, 1e-10);
  EXPECT_NEAR(energy[1], 8, 1e-12);
}

}  // namespace
}  // namespace bahnwerk
