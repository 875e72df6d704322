#include "core/verify/cam/cam_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/verify/cam/law_verifier.hpp"

namespace bahnwerk {
namespace {

constexpr double deg = std::numbers::pi / 180;

/// Up by 20 mm and down again, the polynomial of degree 5 from rest to rest over `rise` deg each, then a dwell.
LawToVerify law(double rise) {
  LawToVerify out;
  out.breaks = {0, rise / 360, rise / 180, 1};
  out.sections = {0, 1, 2};
  out.bernstein = {{0, 0, 0, 20, 20, 20}, {20, 20, 20, 0, 0, 0}, {0, 0}};
  out.cycle_duration = 1;
  return out;
}
double position(double phi, double rise) {  // rad
  const double x = phi / (rise * deg), z = std::max(0.0, x < 1 ? x : 2 - x);
  return phi < 0 ? 0 : 20 * z * z * z * (10 - 15 * z + 6 * z * z);
}
constexpr double usual = 150;  // deg
/// Spans of 2 deg through the envelope of rollers: lines of centres, normals by differences.
CamToVerify cam(double roller, double base, double shift = 0, double rise = usual) {
  const auto centre = [&](double phi, double pitch) {
    const double r = pitch + position(phi, rise);
    return Point{r * std::sin(phi), r * std::cos(phi)};
  };
  CamToVerify out;
  out.geometry.roller_radius = roller;
  out.base_radius = base;
  const auto point = [&](double phi) {
    const double h = 1e-5;
    const Point c = centre(phi, base + roller),
                way = unit(centre(phi + h, base + roller) - centre(phi - h, base + roller));
    return c - (roller - shift) * left_of(way);
  };
  const auto slope = [&](double phi) { return 5e3 * (point(phi + 1e-4) - point(phi - 1e-4)); };
  constexpr int spans = 180;
  for (int k = 0; k <= spans; ++k) out.profile.angles.push_back(2.0 * k);
  for (int k = 0; k < spans; ++k) {
    const double a = 2 * k * deg, b = a + 2 * deg, h = 2 * deg;
    const Point p = point(a), q = point(b), dp = slope(a), dq = slope(b);
    // The cubic of Hermite, raised to degree 5.
    const Point c[4] = {p, p + (h / 3) * dp, q - (h / 3) * dq, q};
    if (k == 0) out.profile.points.push_back(c[0]);
    out.profile.points.push_back(0.4 * c[0] + 0.6 * c[1]);
    out.profile.points.push_back(0.1 * c[0] + 0.6 * c[1] + 0.3 * c[2]);
    out.profile.points.push_back(0.3 * c[1] + 0.6 * c[2] + 0.1 * c[3]);
    out.profile.points.push_back(0.6 * c[2] + 0.4 * c[3]);
    out.profile.points.push_back(c[3]);
  }
  out.profile.points.back() = out.profile.points.front();
  double steepest = 0;
  for (int k = 0; k < 100000; ++k) {
    const double phi = k * rise * deg / 100000, h = 1e-6;
    steepest = std::max(steepest, (position(phi + h, rise) - position(phi - h, rise)) / (2 * h) /
                                      (base + roller + position(phi, rise)));
  }
  out.pressure_angle = std::atan(steepest);
  return out;
}
Verification checked(const CamToVerify& cam, double rise = usual) {
  Progress silent;
  Verification out;
  out.passed = true;
  verify_cam(law(rise), cam, silent, out);
  return out;
}
bool passed(const Verification& v, const std::string& name) {
  const Check* check = v.find({{}, CheckGroup::geometry}, 0, name);
  EXPECT_NE(check, nullptr) << name;
  return check && check->passed;
}

TEST(CamChecks, ARightProfilePasses) {
  const Verification v = checked(cam(10, 40));
  for (const Check& check : v.checks)
    EXPECT_TRUE(check.passed) << check.subject << " " << check.value << " " << check.limit;
  EXPECT_TRUE(v.passed);
}

TEST(CamChecks, AProfileThatIsTooLowLeavesAGap) {
  const Verification v = checked(cam(10, 40, -0.003));
  EXPECT_FALSE(passed(v, "cam contact"));
  EXPECT_TRUE(passed(v, "cam penetration"));
}

TEST(CamChecks, AProfileThatIsTooHighReachesIntoTheRoller) {
  const Verification v = checked(cam(10, 40, 0.003));
  EXPECT_FALSE(passed(v, "cam penetration"));
}

TEST(CamChecks, ADentBetweenTwoAnglesIsFound) {
  CamToVerify dented = cam(10, 40);
  dented.profile.points[203].x += 0.02;
  EXPECT_FALSE(checked(dented).passed);
}

TEST(CamChecks, AnUndercutProfileFails) {
  // The pitch curve's least radius of curvature at the top is below the roller's.
  const Verification v = checked(cam(20, 10, 0, 40), 40);
  EXPECT_FALSE(passed(v, "cam penetration"));
  EXPECT_FALSE(passed(v, "cam undercut"));
}

TEST(CamChecks, APressureAngleAboveItsLimitOrAboveTheReportedOneFails) {
  CamToVerify limited = cam(10, 40);
  limited.geometry.pressure_angle = limited.pressure_angle - 1e-3;
  EXPECT_FALSE(passed(checked(limited), "cam pressure angle"));
  CamToVerify understated = cam(10, 40);
  understated.pressure_angle -= 1e-3;
  EXPECT_FALSE(passed(checked(understated), "cam pressure angle"));
}

TEST(CamChecks, ACurveWithAGapFails) {
  CamToVerify open = cam(10, 40);
  open.profile.points.back().x += 0.01;
  EXPECT_FALSE(passed(checked(open), "cam curve"));
  open.profile.angles.pop_back();
  EXPECT_FALSE(checked(open).passed);
}

TEST(CamChecks, ALightSpringLetsTheFollowerLeaveTheCam) {
  CamToVerify light = cam(10, 40);
  light.geometry.contact = cam::CamContact{1, 0, 2, 10, {}, {}, {}};
  EXPECT_FALSE(passed(checked(light), "cam force"));
}

}  // namespace
}  // namespace bahnwerk
