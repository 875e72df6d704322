// The wire's tension and the brake that keeps it.
#include "core/winding/needle/wire_tension.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk::winding {
namespace {

TEST(WireTension, IsTheBrakesForceWithoutMassAndFriction) {
  const TensionModel model{.force = 12};
  const Drawing drawing{700, 30000, 1.5};
  EXPECT_EQ(tension(model, 17, drawing), 17);
  EXPECT_EQ(compensating_brake(model, drawing), 12);
}

TEST(WireTension, KnownForces) {
  // 0.2 kg at 5 m/s² is 1 N; a right angle at μ = 0.2 raises the rest by e^0.314.
  TensionModel model{.force = 30, .mass = 0.2};
  EXPECT_NEAR(tension(model, 30, {700, 5000, 0}), 31, 1e-12);
  EXPECT_NEAR(tension(model, 30, {700, -5000, 0}), 29, 1e-12);
  model.friction = 0.2;
  const double right = std::acos(0.0);
  EXPECT_NEAR(tension(model, 30, {1e9, 5000, right}), 31 * std::exp(0.2 * right), 1e-9);
  EXPECT_NEAR(tension(model, 30, {-1e9, 5000, right}), 31 * std::exp(-0.2 * right), 1e-9);
  EXPECT_EQ(tension(model, 30, {0, 0, right}), 30);
}

TEST(WireTension, TheBrakeKeepsTheForceWhereItsRangeAllows) {
  Random random(4);
  std::size_t kept = 0, most = 0, none = 0;
  for (int i = 0; i < 5000; ++i) {
    const TensionModel model{
        .force = random.uniform(1, 60), .mass = random.uniform(0, 2), .friction = random.uniform(), .range = 70};
    const Drawing drawing{random.uniform(-2000, 2000), random.uniform(-40000, 40000), random.uniform(0, 2.5)};
    const double brake = compensating_brake(model, drawing);
    ASSERT_GE(brake, 0);
    ASSERT_LE(brake, 70);
    const double force = tension(model, brake, drawing);
    if (brake > 0 && brake < 70) {
      EXPECT_NEAR(force, model.force, 1e-11);
      ++kept;
    } else if (brake == 70) {
      EXPECT_LE(force, model.force + 1e-11);
      ++most;
    } else {
      EXPECT_GE(force, model.force - 1e-11);
      ++none;
    }
  }
  EXPECT_GT(std::min({kept, most, none}), 100u);
}

TEST(WireTension, CopperYields) {
  // A wire of 1 mm at 100 N/mm²: 78.5 N.
  EXPECT_NEAR(yield_pull({1, 1.1, 0}, 100), 78.5398, 1e-4);
  EXPECT_NEAR(yield_pull({0.5, 0.6, 0}), 23.5619, 1e-4);
}

}  // namespace
}  // namespace bahnwerk::winding
