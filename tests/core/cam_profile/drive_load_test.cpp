#include "core/cam_profile/drive_load.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/cam_profile/cam_laws.hpp"

namespace bahnwerk::cam {
namespace {

/// Rises by 30 units in the first half of 0.4 s and falls in the second one, by the polynomial of degree 5.
CamLaw up_and_down() { return {{0, 0.2, 0.4}, {{0, {0, 0, 0, 30, 30, 30}}, {1, {30, 30, 30, 0, 0, 0}}}, true}; }
LoadFigures figures(const DriveLoad& load, const CamLaw& law = up_and_down()) {
  Progress silent;
  return load_figures(linear_load(load), law, silent);
}

TEST(DriveLoad, AMassTakesItsPeakAcceleration) {
  DriveLoad load;
  load.inertia = 4;
  const LoadFigures f = figures(load);
  const double peak = 5.7735026919 * 30 / 0.04;  // mm/s²
  EXPECT_NEAR(f.most.value, 4e-3 * peak, 1e-6 * peak);
  EXPECT_NEAR(f.least.value, -4e-3 * peak, 1e-6 * peak);
  EXPECT_NEAR(f.mean_power, 0, 1e-9);
  // ∫ (60 z − 180 z² + 120 z³)² dz = 120/7.
  EXPECT_NEAR(f.rms, 4e-3 * 30 / 0.04 * std::sqrt(120.0 / 7), 1e-9 * peak);
}

TEST(DriveLoad, ALeadTurnsForcesIntoTorques) {
  DriveLoad load;
  load.inertia = 100, load.force = 981, load.ratio = 10, load.motor_inertia = 2e-4;
  const LoadFigures f = figures(load);
  const double peak = 5.7735026919 * 30 / 0.04, turn = 2 * std::numbers::pi / 10;
  EXPECT_NEAR(f.most.value, (0.1 * peak + 981) / turn / 1000 + 2e-4 * turn * peak, 1e-5);
  double fastest = 0;
  for (const LoadPoint& p : f.points) fastest = std::max(fastest, p.speed);
  EXPECT_NEAR(fastest, 1.875 * 30 / 0.2 / 10 * 60, 1e-6);
  for (const LoadPoint& p : f.points) EXPECT_NEAR(p.power, p.effort * p.speed * std::numbers::pi / 30, 1e-9);
}

TEST(DriveLoad, FrictionActsAgainstTheMotionAndCostsItsWork) {
  DriveLoad load;
  load.inertia = 4, load.friction = 10;
  const LoadFigures f = figures(load);
  EXPECT_NEAR(f.mean_power, 10 * 60e-3 / 0.4, 1e-6);  // 10 N along 60 mm in 0.4 s
  // At the turn the deceleration of the rise and the acceleration of the return both end at 0: friction alone is left.
  const double peak = 5.7735026919 * 30 / 0.04;
  EXPECT_NEAR(f.most.value, 4e-3 * peak + 10, 1e-3);
  EXPECT_NEAR(f.least.value, -(4e-3 * peak + 10), 1e-3);
}

TEST(DriveLoad, ASpringHasItsForceAtEitherEnd) {
  DriveLoad load;
  load.spring = 2, load.spring_zero = -5;
  const LoadFigures f = figures(load);
  EXPECT_NEAR(f.most.value, 70, 1e-6);
  EXPECT_NEAR(f.least.value, 10, 1e-6);
  EXPECT_NEAR(f.mean_power, 0, 1e-9);
}

TEST(DriveLoad, AGearDividesTheTorqueOfARotarySlave) {
  DriveLoad load;
  load.rotary = true, load.inertia = 0.5, load.ratio = 20, load.motor_inertia = 1e-4;
  const LoadFigures f = figures(load);
  const double peak = 5.7735026919 * 30 / 0.04 * test::deg;
  EXPECT_NEAR(f.most.value, 0.5 * peak / 20 + 1e-4 * 20 * peak, 1e-5);
  double fastest = 0;
  for (const LoadPoint& p : f.points) fastest = std::max(fastest, p.speed);
  EXPECT_NEAR(fastest, 1.875 * 30 / 0.2 / 6 * 20, 1e-6);
}

TEST(DriveLoad, AccelerationsWithinAPeakLeaveRoomForFrictionAndWeight) {
  DriveLoad load;
  load.inertia = 10, load.force = 20, load.friction = 5;
  const Range range = acceleration_within(linear_load(load), 100);
  EXPECT_NEAR(range.max, (100 - 20 - 5) / 0.01, 1e-9);
  EXPECT_NEAR(range.min, -(100 + 20 - 5) / 0.01, 1e-9);
}

}  // namespace
}  // namespace bahnwerk::cam
