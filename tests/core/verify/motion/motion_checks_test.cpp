// Motions with known peaks and planted faults: a quintic of one axis, splines that jump, sums, a path of five axes.
#include "core/verify/motion/motion_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/motion/axes/five_axes.hpp"

namespace bahnwerk {
namespace {

/// Rest to rest over `way` in T: x = way (10 u³ − 15 u⁴ + 6 u⁵), u = t/T. Peaks: 15/8 way/T, 10/√3 way/T², 60 way/T³,
/// 360 way/T⁴.
SplineMotion quintic(double way, double T) {
  return SplineMotion(
      {{T, {{0, 0, 0, 10 * way / std::pow(T, 3), -15 * way / std::pow(T, 4), 6 * way / std::pow(T, 5)}}}});
}

AxisLimits limits(double velocity, double acceleration, double jerk, double snap = unlimited) {
  AxisLimits axis("b", velocity, acceleration, jerk);
  axis.snap = snap;
  axis.unit = "rad";
  return axis;
}

std::vector<Check> verify_axes(const Motion& motion, const std::vector<AxisLimits>& axes, int continuous = 2) {
  Progress progress;
  return motion_checks({motion, axes, continuous}, progress);
}

const Check& named(const std::vector<Check>& checks, const std::string& name) {
  for (const Check& check : checks)
    if (check_name(check) == name) return check;
  throw std::out_of_range(name);
}

testing::AssertionResult passed(const std::vector<Check>& checks) {
  auto result = testing::AssertionSuccess();
  for (const Check& check : checks)
    if (!check.passed)
      result = testing::AssertionFailure()
               << check_name(check) << ": " << check.value << " > " << check.limit << " at " << check.at;
  return result;
}

TEST(MotionChecks, OneAxisHasThePeaksOfItsClosedForm) {
  const double way = 3.7, T = 0.83;
  const SplineMotion motion = quintic(way, T);
  const double v = 15.0 / 8 * way / T, a = 10 / std::sqrt(3.0) * way / (T * T), j = 60 * way / std::pow(T, 3),
               s = 360 * way / std::pow(T, 4);
  AxisLimits axis = limits(v, a, j, s);
  axis.lowest = 0, axis.highest = way;
  const auto checks = verify_axes(motion, {axis});
  EXPECT_TRUE(passed(checks));
  EXPECT_NEAR(named(checks, "velocity b").value, v, 1e-12 * v);
  EXPECT_NEAR(named(checks, "velocity b").at, T / 2, 1e-6);
  EXPECT_NEAR(named(checks, "acceleration b").value, a, 1e-12 * a);
  EXPECT_NEAR(named(checks, "jerk b").value, j, 1e-12 * j);
  EXPECT_NEAR(named(checks, "snap b").value, s, 1e-12 * s);
  EXPECT_EQ(check_unit(named(checks, "jerk b")), "rad/s³");
}

/// x = (t (1 − t))¹⁰ t.
TEST(MotionChecks, PeaksOfDegree21AreEnclosed) {
  Polynomial bump{1};
  for (int i = 0; i < 10; ++i) bump = bump * Polynomial{0, 1, -1};
  const SplineMotion motion({{1, {bump * Polynomial{0, 1}}}});
  const auto checks = verify_axes(motion, {limits(1, unlimited, unlimited)}, 3);
  EXPECT_TRUE(passed(checks));
  // x′ = t¹⁰ (1 − t)⁹ (11 − 21 t): its extremes by a fine grid.
  double most = 0;
  for (int i = 0; i <= 1'000'000; ++i) {
    const double t = i * 1e-6;
    most = std::max(most, std::abs(std::pow(t, 10) * std::pow(1 - t, 9) * (11 - 21 * t)));
  }
  EXPECT_NEAR(named(checks, "velocity b").value, most, 1e-9 * most);
  EXPECT_GE(named(checks, "velocity b").value, most * (1 - 1e-10));
}

TEST(MotionChecks, ALimitThatIsAMillionthTooLowFails) {
  const double way = 3.7, T = 0.83, v = 15.0 / 8 * way / T, a = 10 / std::sqrt(3.0) * way / (T * T),
               j = 60 * way / std::pow(T, 3);
  const SplineMotion motion = quintic(way, T);
  EXPECT_FALSE(named(verify_axes(motion, {limits(v * (1 - 1e-6), a, j)}), "velocity b").passed);
  EXPECT_FALSE(named(verify_axes(motion, {limits(v, a * (1 - 1e-6), j)}), "acceleration b").passed);
  EXPECT_FALSE(named(verify_axes(motion, {limits(v, a, j * (1 - 1e-6))}), "jerk b").passed);
  AxisLimits narrow = limits(v, a, j);
  narrow.highest = way * (1 - 1e-6);
  EXPECT_FALSE(named(verify_axes(motion, {narrow}), "range b").passed);
  narrow.highest = unlimited, narrow.lowest = 1e-6;
  EXPECT_FALSE(named(verify_axes(motion, {narrow}), "range b").passed);
}

TEST(MotionChecks, JumpsAreFoundWhereTheyAre) {
  // x = t²/2 to 1 s, then on with its speed; the second piece is moved by a micrometre, quicker by as much, or bends.
  const auto spline = [](double dx, double dv, double da) {
    return SplineMotion({{1, {{0, 0, 0.5}}}, {2, {{0.5 + dx, 1 + dv, 0.5 * (1 + da)}}}});
  };
  const std::vector<AxisLimits> axes{limits(10, 10, unlimited)};
  const auto check = [&](double dx, double dv, double da, const std::string& name) {
    const SplineMotion motion = spline(dx, dv, da);
    Progress progress;
    return named(motion_checks({motion, axes, 2, false, false}, progress), name);
  };
  for (const std::string name : {"continuity of position", "continuity of velocity", "continuity of acceleration"})
    EXPECT_TRUE(check(0, 0, 0, name).passed) << name;
  EXPECT_FALSE(check(1e-9, 0, 0, "continuity of position").passed);
  EXPECT_FALSE(check(0, 1e-9, 0, "continuity of velocity").passed);
  EXPECT_FALSE(check(0, 0, 1e-9, "continuity of acceleration").passed);
  EXPECT_EQ(check(0, 1e-9, 0, "continuity of velocity").at, 1);
  EXPECT_TRUE(check(0, 0, 1e-9, "continuity of velocity").passed);
}

TEST(MotionChecks, RestIsAskedForAtBothEnds) {
  const SplineMotion moving({{1, {{0, 1e-9, 0.5}}}});
  const auto checks = verify_axes(moving, {limits(10, 10, unlimited)}, 1);
  EXPECT_FALSE(named(checks, "start at rest").passed);
  EXPECT_FALSE(named(checks, "end at rest").passed);
}

TEST(MotionChecks, NotANumberFails) {
  const SplineMotion broken({{1, {{0, 0, std::nan(""), 1}}}});
  const auto checks = verify_axes(broken, {limits(10, 10, unlimited)});
  for (const std::string name : {"velocity b", "acceleration b", "start at rest", "end at rest"})
    EXPECT_FALSE(named(checks, name).passed) << name;
}

TEST(MotionChecks, PeaksOfRandomSplinesAreNeverBelowTheirSamples) {
  Random random(7);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Polynomial> axes(3);
    for (Polynomial& p : axes)
      for (int i = 0; i <= 8; ++i) p.push_back(random.uniform(-1, 1));
    const double T = random.uniform(0.2, 2);
    const SplineMotion motion({{T, axes}});
    std::vector<AxisLimits> free(3, limits(1e-3, 1e-3, 1e-3));
    for (std::size_t k = 0; k < 3; ++k) free[k].name = "a" + std::to_string(k);
    const auto checks = verify_axes(motion, free);
    AxisArray v{}, a{}, j{};
    for (int i = 0; i <= 2000; ++i) {
      const MotionState x = motion.in_piece(0, T * i / 2000);
      for (std::size_t k = 0; k < 3; ++k) {
        v[k] = std::max(v[k], std::abs(x[1][k]));
        a[k] = std::max(a[k], std::abs(x[2][k]));
        j[k] = std::max(j[k], std::abs(x[3][k]));
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string name = free[k].name;
      for (const auto& [found, sampled] : {std::pair{named(checks, "velocity " + name).value, v[k]},
                                           std::pair{named(checks, "acceleration " + name).value, a[k]},
                                           std::pair{named(checks, "jerk " + name).value, j[k]}}) {
        EXPECT_GE(found, sampled * (1 - 1e-12));
        EXPECT_LE(found, sampled * (1 + 1e-3));
      }
    }
  }
}

/// Coarse + fine: the tool follows a path that neither does alone.
TEST(MotionChecks, SumsAreVerifiedAsTheMotionTheyAre) {
  const auto coarse = std::make_shared<SplineMotion>(quintic(100, 2));
  const auto fine = std::make_shared<SplineMotion>(
      SplineMotion({{1, {{0, 0, 0, 10, -15, 6}}}, {2, {{1, 0, 0, -10, 15, -6}}}}));  // there and back by 1
  const SumOfMotions sum(coarse, fine);
  const auto checks = verify_axes(sum, {limits(1000, 1000, 10000)});
  EXPECT_TRUE(passed(checks));
  const double bend = 60 * 100 / 8.0 + 60;  // both jerks have their largest value at t = 0
  EXPECT_NEAR(named(checks, "jerk b").value, bend, 1e-9 * bend);
}

/// Five axes through kinematics: what the verifier of motions finds without knowing of path or law.
TEST(MotionChecks, FiveAxesDrivenAlongAPath) {
  ContourBuilder b(2, {});
  b.line({40, 0, 0});
  b.arc({60, 20, 0}, {40, 20, 0}, true);
  const Contour contour = b.finish();
  const test::FiveAxes kinematics;
  const Machine machine{kinematics.axes(), 0.001};
  const auto axes = std::make_shared<const KinematicAxisPath>(contour.path, kinematics);
  const AxisPath& path = *axes;
  Progress progress;
  constexpr double resolution = 2e-11;  // s: 1e-10 of 40 mm at some 200 mm/s
  const PathMotion smooth(axes, plan_jerk_limited(contour_task(path, contour, machine), {}, progress).law);
  EXPECT_TRUE(passed(motion_checks({smooth, machine.axes, 1, true, true, resolution}, progress)));
  const PathMotion quick(axes, plan_acceleration_limited(contour_task(path, contour, machine), {}, progress).law);
  std::vector<AxisLimits> without_jerk = machine.axes;
  for (AxisLimits& axis : without_jerk) axis.jerk = unlimited;
  const auto checks = motion_checks({quick, without_jerk, 1, true, true, resolution}, progress);
  EXPECT_TRUE(passed(checks));
  // Whichever axis is used to its limit is missed when that is a little lower.
  bool used = false;
  for (std::size_t k = 0; k < 5; ++k) {
    const Check& peak = named(checks, "acceleration " + machine.axes[k].name);
    if (peak.value < peak.limit * (1 - 1e-7)) continue;
    used = true;
    auto lower = without_jerk;
    lower[k].acceleration *= 1 - 1e-6;
    EXPECT_FALSE(passed(motion_checks({quick, lower, 1, true, true, resolution}, progress)));
  }
  EXPECT_TRUE(used);
}

}  // namespace
}  // namespace bahnwerk
