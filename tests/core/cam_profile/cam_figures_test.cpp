#include "core/cam_profile/cam_figures.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/cam_profile/cam_laws.hpp"

namespace bahnwerk::cam {
namespace {

using test::deg;

CamFigures figures(const CamGeometry& g, const CamLaw& law, double base, double unit = 1) {
  Progress silent;
  return cam_figures(g, FollowerLaw(law, unit), base, silent);
}

// A harmonic law over the whole turn moves a flat face as a circle does whose centre is half of the stroke off the
// axis.
TEST(CamFigures, AHarmonicLawUnderAFlatFaceIsACircle) {
  CamGeometry g;
  g.follower = FollowerType::flat;
  const CamLaw law = test::rise_and_return(ClassicalLaw::simple_harmonic, 20, 180, 0, 180, 0);
  const CamFigures f = figures(g, law, 25);
  EXPECT_NEAR(f.profile_radius->value, 35, 1e-5);
  EXPECT_NEAR(f.face_width, 20, 1e-6);
  EXPECT_LT(f.undercut_bound, 0);
}

// With a roller whose path goes through the axis the same law has the pitch radius r + h/2 (1 − cos φ), a limaçon:
// tan α = r'/r, curvature (r² + 2 r'² − r r″)/(r² + r'²)^1.5.
TEST(CamFigures, ARollerOnALimaconHasItsCurvatureAndPressureAngle) {
  CamGeometry g;
  g.roller_radius = 8;
  const CamLaw law = test::rise_and_return(ClassicalLaw::simple_harmonic, 20, 180, 0, 180, 0);
  const CamFigures f = figures(g, law, 30);
  double steepest = 0, tightest = 0;
  for (int k = 0; k <= 200000; ++k) {
    const double phi = k * 1e-5 * std::numbers::pi / 2, r = 38 + 10 * (1 - std::cos(phi)), d = 10 * std::sin(phi),
                 dd = 10 * std::cos(phi);
    steepest = std::max(steepest, std::atan(d / r));
    tightest = std::max(tightest, (r * r + 2 * d * d - r * dd) / std::pow(r * r + d * d, 1.5));
  }
  EXPECT_NEAR(f.pressure_angle.value, steepest, 1e-7);
  EXPECT_NEAR(f.pressure_angle_back.value, -steepest, 1e-7);
  EXPECT_NEAR(f.profile_radius->value, 1 / tightest - 8, 1e-5);
}

// Norton, Cam Design and Manufacturing Handbook, 7: tan α = (v − e)/(s + √(Rp² − e²)); cycloidal rise.
TEST(CamFigures, PressureAnglesAreThoseOfTheTextbooksFormula) {
  CamGeometry g;
  g.roller_radius = 10, g.offset = 6;
  const CamLaw law = test::rise_and_return(ClassicalLaw::inclined_sine, 25, 100, 40, 120, 100);
  const CamFigures f = figures(g, law, 35);
  double rise = -1, back = 1;
  const double width = 100 * deg, there = 120 * deg, start = std::sqrt(45.0 * 45 - 36);
  for (int k = 0; k <= 100000; ++k) {
    const double z = k * 1e-5, turn = 2 * std::numbers::pi;
    const double s = z - std::sin(turn * z) / turn, v = 1 - std::cos(turn * z);
    rise = std::max(rise, std::atan((25 / width * v - 6) / (25 * s + start)));
    back = std::min(back, std::atan((-25 / there * v - 6) / (25 * (1 - s) + start)));
  }
  EXPECT_NEAR(f.pressure_angle.value, rise, 1e-7);
  EXPECT_NEAR(f.pressure_angle_back.value, back, 1e-7);
  g.clockwise = true, g.offset = -6;  // the mirror image
  const CamFigures mirrored = figures(g, law, 35);
  EXPECT_NEAR(mirrored.pressure_angle.value, rise, 1e-8);
  EXPECT_NEAR(mirrored.profile_radius->value, f.profile_radius->value, 1e-5);
}

TEST(CamFigures, ALongArmIsATranslatingFollower) {
  CamGeometry straight, swinging;
  straight.roller_radius = swinging.roller_radius = 10;
  swinging.follower = FollowerType::oscillating;
  swinging.arm = 1e6, swinging.distance = std::hypot(1e6, 45.0 + 10);
  const CamLaw law = test::rise_and_return(ClassicalLaw::polynomial_345, 20, 90, 30, 120, 120);
  const CamFigures a = figures(straight, law, 35), b = figures(swinging, law, 35, 1e-6);
  EXPECT_NEAR(a.pressure_angle.value, b.pressure_angle.value, 1e-3);
  EXPECT_NEAR(a.profile_radius->value, b.profile_radius->value, 1e-2);
}

TEST(CamFigures, ABarrelsPressureAngleIsThatOfTheUnrolledGroove) {
  CamGeometry g;
  g.type = CamType::barrel;
  g.roller_radius = 6;
  const CamLaw law = test::rise_and_return(ClassicalLaw::modified_sine, 40, 120, 60, 120, 60);
  const CamFigures f = figures(g, law, 60);
  EXPECT_NEAR(std::tan(f.pressure_angle.value), 1.759603 * 40 / (120 * deg) / 60, 1e-6);
  EXPECT_NEAR(f.pressure_angle.value, -f.pressure_angle_back.value, 1e-7);
  EXPECT_LT(f.undercut_bound, 0);
}

// Hertz for two parallel cylinders: p = √(F E* /(π b ρ)), 1/E* = 2 (1 − ν²)/E, 1/ρ = 1/8 + 1/30 in a dwell.
TEST(CamFigures, AConstantForceInADwellHasHertzPressure) {
  CamGeometry g;
  g.roller_radius = 8;
  g.contact = CamContact{500, 0, 0, 12, {}, {}, {}};
  const CamLaw law({0, 1}, {{0, {0, 0}}}, true);
  const CamFigures f = figures(g, law, 30);
  const double stiffness = 210000 / (2 * 0.91),
               expected = std::sqrt(500 * stiffness * (1 / 8.0 + 1 / 30.0) / (12 * std::numbers::pi));
  EXPECT_NEAR(f.contact->stress.value, expected, 1e-6 * expected);
}

TEST(CamFigures, ACuspIsNamedByItsAngle) {
  CamGeometry g;
  g.roller_radius = 22;
  const CamLaw law = test::rise_and_return(ClassicalLaw::polynomial_345, 30, 45, 0, 45, 270);
  const CamFigures f = figures(g, law, 20);
  EXPECT_GT(f.undercut_bound, 0);
  EXPECT_LT(f.profile_radius->value, 0);
  EXPECT_NEAR(f.profile_radius->at / deg, 45, 15);
}

}  // namespace
}  // namespace bahnwerk::cam
