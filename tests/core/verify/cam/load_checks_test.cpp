#include "core/verify/cam/load_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/verify/cam/law_verifier.hpp"

namespace bahnwerk {
namespace {

constexpr double peak_acceleration = 5.773502691896258 * 30 / 0.04;  // mm/s²

Verification checked(const LoadToVerify& load) {
  LawToVerify law;
  law.breaks = {0, 0.2, 0.4};
  law.sections = {0, 1};
  law.bernstein = {{0, 0, 0, 30, 30, 30}, {30, 30, 30, 0, 0, 0}};
  law.cycle_duration = 0.4;
  Progress silent;
  Verification out;
  out.passed = true;
  verify_load(law, load, silent, out);
  return out;
}
LoadToVerify mass(double peak) {
  LoadToVerify load;
  load.load.inertia = 4, load.load.friction = 10;
  load.peak = peak, load.rms = std::hypot(4e-3 * 30 / 0.04 * std::sqrt(120.0 / 7), 10);
  return load;
}

TEST(LoadChecks, RightFiguresPass) {
  const Verification v = checked(mass(4e-3 * peak_acceleration + 10));
  for (const Check& check : v.checks)
    EXPECT_TRUE(check.passed) << check.subject << " " << check.value << " " << check.limit;
}

TEST(LoadChecks, APeakAboveTheReportedOneOrTheLimitFails) {
  EXPECT_FALSE(checked(mass(4e-3 * peak_acceleration + 9.99)).passed);
  LoadToVerify limited = mass(4e-3 * peak_acceleration + 10);
  limited.limits.peak = 4e-3 * peak_acceleration + 9.99;
  EXPECT_FALSE(checked(limited).passed);
}

TEST(LoadChecks, ARootMeanSquareAboveItsLimitFails) {
  LoadToVerify limited = mass(4e-3 * peak_acceleration + 10);
  limited.limits.rms = 0.99 * limited.rms;
  EXPECT_FALSE(checked(limited).passed);
}

TEST(LoadChecks, AGearAndTheMotorsInertiaCount) {
  LoadToVerify load;
  load.load.rotary = true, load.load.inertia = 0.5, load.load.ratio = 20, load.load.motor_inertia = 1e-4;
  const double a = peak_acceleration * std::acos(-1) / 180;
  load.peak = 0.5 * a / 20 + 1e-4 * 20 * a, load.rms = load.peak;
  EXPECT_TRUE(checked(load).passed);
  load.peak *= 0.999;
  EXPECT_FALSE(checked(load).passed);
}

}  // namespace
}  // namespace bahnwerk
