// The verifier on laws with jerk and snap: true peaks of quartic pieces, and continuity of acceleration.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/verify/law/verifier.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

Machine machine() {
  Machine m;
  m.axes = {{"x", 1000, 10000, 1e6}, {"y", 1000, 10000, 1e6}};
  return m;
}

/// Rest to rest over `length` in time T with v = 30 L/T τ² (1 − τ)², which is cut into n quartic pieces of s whose
/// speed and acceleration at the ends are exact.
TimeLaw bow(double length, double T, int n, std::size_t segment = 0) {
  const auto state = [&](double x) {
    const double y = 1 - x;
    return LawState{length * x * x * x * (10 - 15 * x + 6 * x * x), 30 * length / T * x * x * y * y,
                    60 * length / (T * T) * x * y * (1 - 2 * x), 0};
  };
  TimeLaw law;
  double s = 0;
  for (int i = 0; i < n; ++i) {
    const LawState l = state(static_cast<double>(i) / n), r = state(static_cast<double>(i + 1) / n);
    const double h = T / n, m6 = 6 * (r.v - l.v) / h;
    LawPiece p;
    p.duration = h;
    p.s = s;
    p.v = l.v;
    p.a = l.a;
    p.j = (m6 - 4 * l.a - 2 * r.a) / h;
    p.snap = ((2 * l.a + 4 * r.a - m6) / h - p.j) / h;
    p.segment = segment;
    s = p.s_end = p.at(h).s;
    law.append(p);
  }
  return law;
}

const Check& find(const Verification& v, const std::string& name) {
  const auto at = std::find_if(v.checks.begin(), v.checks.end(), [&](const Check& c) { return check_name(c) == name; });
  EXPECT_NE(at, v.checks.end()) << name;
  return *at;
}

Verification verdict(const Contour& contour, const TimeLaw& law, double path_acceleration = unlimited,
                     double path_jerk = unlimited) {
  Progress silent;
  const Machine m = machine();
  ContourVerifierInput input{contour, m, law, 1e-3, 3};
  input.path.acceleration = path_acceleration;
  input.path.jerk = path_jerk;
  return verify_motion(input, silent);
}

/// Largest |value| over a dense sampling.
double dense(const Contour& contour, const TimeLaw& law, const std::function<double(const MotionState&)>& value) {
  const PathMotion motion(contour_axes(std::make_shared<const Contour>(contour), 2), law);
  double most = 0;
  std::size_t hint = 0;
  for (const LawPiece& p : law.pieces())
    for (int i = 0; i <= 400; ++i)
      most = std::max(most, std::abs(value(motion.evaluate(p.t0 + p.duration * std::min(i / 400.0, 1 - 1e-12), hint))));
  return most;
}

void agrees(const Contour& contour, const TimeLaw& law) {
  const Verification v = verdict(contour, law);
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    const std::string axis = k ? "y" : "x";
    const auto expect = [&](const std::string& name, double sampled) {
      const double verified = find(v, name + " " + axis).value;
      EXPECT_GE(verified, sampled * (1 - 1e-9)) << name << axis;
      EXPECT_LE(verified, sampled * (1 + 1e-4) + 1e-6) << name << axis;
    };
    expect("velocity", dense(contour, law, [&](const MotionState& s) { return s[1][k]; }));
    expect("acceleration", dense(contour, law, [&](const MotionState& s) { return s[2][k]; }));
    expect("jerk", dense(contour, law, [&](const MotionState& s) { return s[3][k]; }));
  }
}

Contour line() {
  ContourBuilder b(2, {});
  b.line({30, 40, 0});
  return b.finish();
}
Contour curve() {
  ContourBuilder b(2, {});
  b.polynomial({{0, 30, 10, -20}, {0, 5, 40, -25}});
  return b.finish();
}

TEST(VerifierJerk, PeaksOnALine) { agrees(line(), bow(50, 0.4, 5)); }

TEST(VerifierJerk, PeaksOnACurve) {
  const Contour contour = curve();
  agrees(contour, bow(contour.path.length(), 0.4, 7));
}

TEST(VerifierJerk, SmoothLawPasses) {
  const TimeLaw law = bow(50, 0.4, 5);
  const double way = law.pieces().back().s_end;
  ContourBuilder b(2, {});
  b.line({0.6 * way, 0.8 * way, 0});
  const Verification v = verdict(b.finish(), law);
  for (const Check& c : v.checks) EXPECT_TRUE(c.passed) << check_name(c) << ' ' << c.value << " > " << c.limit;
}

TEST(VerifierJerk, AccelerationMustNotJump) {
  TimeLaw law = bow(50, 0.4, 4), broken;
  for (LawPiece p : law.pieces()) {
    if (p.t0 > 0.15 && p.t0 < 0.25) {  // the same way, time and speeds at the ends, another acceleration
      const double h = p.duration, more = 5;
      p.a += more;
      p.j -= 6 * more / h;
      p.snap += 12 * more / (h * h);
      EXPECT_NEAR(p.at(h).s, p.s_end, 1e-9);
    }
    broken.append(p);
  }
  const Verification v = verdict(line(), broken);
  EXPECT_TRUE(find(v, "continuity of velocity").passed);
  EXPECT_FALSE(find(v, "continuity of acceleration").passed);
}

TEST(VerifierJerk, AccelerationMustVanishAtRest) {
  TimeLaw law;  // constant acceleration and braking: fine without jerk limits, not with them
  law.append({0, 0.2, 0, 25, 0, 1250, 0, 0});
  law.append({0, 0.2, 25, 50, 250, -1250, 0, 0});
  EXPECT_FALSE(find(verdict(line(), law), "continuity of acceleration").passed);
}

TEST(VerifierJerk, PathLimitsAreVerified) {
  const TimeLaw law = bow(50, 0.4, 64);
  const double a = 10 / std::sqrt(3.0) * 50 / 0.16, j = 60 * 50 / 0.064;  // of this polynomial
  EXPECT_NEAR(find(verdict(line(), law, 2 * a), "path acceleration").value, a, 1e-3 * a);
  EXPECT_NEAR(find(verdict(line(), law, unlimited, 2 * j), "path jerk").value, j, 0.02 * j);
  EXPECT_FALSE(find(verdict(line(), law, 0.9 * a), "path acceleration").passed);
  EXPECT_FALSE(find(verdict(line(), law, unlimited, 0.9 * j), "path jerk").passed);
}

TEST(VerifierJerk, PathSnapIsTheLargestOfAnyPiece) {
  const Contour contour = line();
  const TimeLaw law = bow(50, 0.4, 64);
  double snap = 0;
  for (const LawPiece& piece : law.pieces()) snap = std::max(snap, std::abs(piece.snap));
  ASSERT_GT(snap, 0);
  const Machine m = machine();
  for (const double share : {0.999, 1.001}) {
    Progress silent;
    ContourVerifierInput input{contour, m, law, 1e-3, 3};
    input.path.snap = share * snap;
    const Verification v = verify_motion(input, silent);
    const Check* check = v.find(quantity::path, 4);
    ASSERT_NE(check, nullptr);
    EXPECT_DOUBLE_EQ(check->value, snap);
    EXPECT_EQ(check->passed, share > 1);
    EXPECT_EQ(check_name(*check), "path snap");
    EXPECT_EQ(check_unit(*check), "mm/s⁴");
  }
}

TEST(VerifierJerk, AccelerationStepWhereCurvatureJumps) {
  ContourBuilder b(2, {});
  b.line({30, 0, 0});
  b.arc({30, 10, 0}, {30, 5, 0}, true);
  const Contour contour = b.finish();
  const double v = 100, T1 = 0.6, r = 5;  // rest – v over the line, v – rest over the arc: the step is v²/r in y
  const double arc = M_PI * r, T2 = 2 * arc / v;
  TimeLaw law;
  const auto ramp = [&](double s, double length, double T, double v0, double v1, std::size_t segment) {
    LawPiece p;  // v = v0 + (v1 − v0)(3τ² − 2τ³)
    p.duration = T, p.s = s, p.s_end = s + length, p.v = v0, p.segment = segment;
    p.j = 6 * (v1 - v0) / (T * T);
    p.snap = -2 * p.j / T;
    law.append(p);
  };
  ramp(0, 30, T1, 0, v, 0);
  ramp(30, arc, T2, v, 0, 1);
  const Verification verdict_ = verdict(contour, law);
  const Check& step = find(verdict_, "acceleration step at joints");
  EXPECT_NEAR(step.value, v * v / r, 1e-6);
  EXPECT_NEAR(step.limit, 1e6 * machine().cycle_time, 1e-9);
  EXPECT_FALSE(step.passed);
}

}  // namespace
}  // namespace bahnwerk
