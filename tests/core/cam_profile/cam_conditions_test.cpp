#include "core/cam_profile/cam_conditions.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/cam_profile/cam_figures.hpp"
#include "tests/core/cam_profile/cam_laws.hpp"

namespace bahnwerk::cam {
namespace {

using test::deg;

LeastRadius least(const CamGeometry& g, const CamLaw& law, double unit = 1) {
  Progress silent;
  const auto found = least_base_radius(g, FollowerLaw(law, unit), cam_conditions(g), silent);
  EXPECT_TRUE(found);
  EXPECT_LE(found->excluded, found->base_radius);
  EXPECT_NEAR(found->excluded, found->base_radius, 3e-6 * (found->base_radius + g.roller_radius + g.distance));
  return *found;
}

// r ≥ max(−(s + s″)) + ρ, Norton 7: the condition of a flat follower.
TEST(CamConditions, AFlatFollowersLeastRadiusIsThatOfTheTextbook) {
  CamGeometry g;
  g.follower = FollowerType::flat, g.profile_radius = 3;
  const CamLaw law = test::rise_and_return(ClassicalLaw::inclined_sine, 20, 90, 20, 90, 160);
  double needed = -1e9;
  const double width = 90 * deg, turn = 2 * std::numbers::pi;
  for (int k = 0; k <= 1000000; ++k) {
    const double z = k * 1e-6, s = 20 * (z - std::sin(turn * z) / turn),
                 a = 20 * turn * std::sin(turn * z) / (width * width);
    needed = std::max(needed, -(s + a));
  }
  EXPECT_NEAR(least(g, law).base_radius, needed + 3, 2e-4);
}

// √(r² − e²) ≥ (|s′ − e|)/tan α − s.
TEST(CamConditions, ATranslatingFollowersLeastRadiusKeepsThePressureAngle) {
  for (const double offset : {0.0, 5.0, -5.0}) {
    CamGeometry g;
    g.roller_radius = 1, g.offset = offset, g.pressure_angle = 30 * deg;
    const CamLaw law = test::rise_and_return(ClassicalLaw::inclined_sine, 25, 110, 30, 110, 110);
    double height = 0;
    const double width = 110 * deg, turn = 2 * std::numbers::pi;
    for (int k = 0; k <= 1000000; ++k) {
      const double z = k * 1e-6, s = 25 * (z - std::sin(turn * z) / turn), v = 25 * (1 - std::cos(turn * z)) / width;
      for (const double each : {v, -v}) height = std::max(height, std::abs(each - offset) / std::tan(30 * deg) - s);
    }
    EXPECT_NEAR(least(g, law).base_radius, std::hypot(height, offset) - 1, 2e-4) << offset;
  }
}

TEST(CamConditions, NoSmallerRadiusOfAnOscillatingFollowerKeepsTheLimits) {
  CamGeometry g;
  g.follower = FollowerType::oscillating;
  g.arm = 80, g.distance = 100, g.roller_radius = 10, g.pressure_angle = 35 * deg;
  const CamLaw law = test::rise_and_return(ClassicalLaw::polynomial_345, 20, 120, 40, 120, 80);
  for (const bool clockwise : {false, true}) {
    g.clockwise = clockwise;
    const LeastRadius found = least(g, law, deg);
    Progress silent;
    const FollowerLaw follower(law, deg);
    const CamFigures at = cam_figures(g, follower, found.base_radius, silent);
    EXPECT_LE(std::max(at.pressure_angle.value, -at.pressure_angle_back.value), 35 * deg + 1e-9);
    EXPECT_LT(at.undercut_bound, 1e-9);
    EXPECT_FALSE(conditions_hold(g, follower, cam_conditions(g), 0.999 * pitch_radius(g, found.base_radius), silent));
  }
}

TEST(CamConditions, ALargerBarrelHasASmallerPressureAngle) {
  CamGeometry g;
  g.type = CamType::barrel;
  g.roller_radius = 5, g.pressure_angle = 30 * deg;
  const CamLaw law = test::rise_and_return(ClassicalLaw::modified_sine, 40, 120, 60, 120, 60);
  EXPECT_NEAR(least(g, law).base_radius, 1.759603 * 40 / (120 * deg) / std::tan(30 * deg), 1e-3);
}

TEST(CamConditions, AnArmThatIsTooShortDoesNotReach) {
  CamGeometry g;
  g.follower = FollowerType::oscillating;
  g.arm = 30, g.distance = 100;
  const FollowerLaw law(test::rise_and_return(ClassicalLaw::polynomial_345, 20, 120, 40, 120, 80), deg);
  EXPECT_FALSE(follower_reaches(g, law, 60));
  EXPECT_TRUE(follower_reaches(g, law, 80));
}

}  // namespace
}  // namespace bahnwerk::cam
