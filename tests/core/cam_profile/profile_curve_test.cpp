#include "core/cam_profile/profile_curve.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/cam_profile/cam_laws.hpp"

namespace bahnwerk::cam {
namespace {

using test::deg;

Point at(const NurbsPath& curve, double angle) {
  const SplinePoint p = curve.at(angle)[0];
  return {p[0], p[1]};
}

TEST(ProfileCurve, AHarmonicLawUnderAFlatFaceIsACircleWithinTheTolerance) {
  Progress silent;
  CamGeometry g;
  g.follower = FollowerType::flat, g.tolerance = 1e-4;
  const FollowerLaw law(test::rise_and_return(ClassicalLaw::simple_harmonic, 20, 180, 0, 180, 0), 1);
  const NurbsPath curve = cam_curve(g, law, 25, CamCurve::profile, silent);
  for (int k = 0; k <= 1440; ++k) EXPECT_NEAR(distance(at(curve, k / 4.0), {0, -10}), 35, 1e-4) << k;
}

TEST(ProfileCurve, DerivativesAreThoseByDifferences) {
  CamGeometry radial, swinging, flat, barrel;
  radial.roller_radius = swinging.roller_radius = barrel.roller_radius = 9;
  radial.offset = 4, radial.clockwise = true;
  swinging.follower = FollowerType::oscillating, swinging.arm = 80, swinging.distance = 100;
  flat.follower = FollowerType::flat;
  barrel.type = CamType::barrel;
  const CamLaw law = test::rise_and_return(ClassicalLaw::polynomial_4567, 18, 110, 40, 130, 80);
  for (const CamGeometry& g : {radial, swinging, flat, barrel})
    for (const CamCurve which : {CamCurve::pitch, CamCurve::profile, CamCurve::other_flank})
      for (const double x : {0.2, 0.5, 0.9}) {
        const FollowerLaw y(law, g.follower == FollowerType::oscillating ? deg : 1);
        const double h = 1e-4 * y.width(0);
        const auto point = [&](double dx) { return cam_curve_point(g, y, 40, which, 0, x + dx); };
        const CamCurvePoint p = point(0), a = point(-1e-4), b = point(1e-4);
        EXPECT_LT(distance(p.first, 1 / (2 * h) * (b.value - a.value)), 1e-4 * (1 + norm(p.second)));
        EXPECT_LT(distance(p.second, 1 / (2 * h) * (b.first - a.first)), 1e-3 * (1 + norm(p.second)));
      }
}

TEST(ProfileCurve, TheRollersCentreIsOneRadiusAway) {
  Progress silent;
  CamGeometry g;
  g.roller_radius = 9;
  const FollowerLaw law(test::rise_and_return(ClassicalLaw::modified_sine, 18, 110, 40, 130, 80), 1);
  const NurbsPath profile = cam_curve(g, law, 40, CamCurve::profile, silent),
                  pitch = cam_curve(g, law, 40, CamCurve::pitch, silent);
  for (int k = 0; k <= 720; ++k) {
    EXPECT_NEAR(distance(at(profile, k / 2.0), at(pitch, k / 2.0)), 9, 1e-3);
    EXPECT_LT(norm(at(profile, k / 2.0)), norm(at(pitch, k / 2.0)));
  }
  EXPECT_EQ(profile.points.front(), profile.points.back());
}

}  // namespace
}  // namespace bahnwerk::cam
