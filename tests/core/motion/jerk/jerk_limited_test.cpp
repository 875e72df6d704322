#include "core/motion/jerk/jerk_limited.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/numeric/random.hpp"
#include "core/verify/law/verifier.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/motion/reference/jerk_curves.hpp"
#include "tests/core/motion/same_bits.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

constexpr double converged = 1e-3;  // relative: by what the planner's duration may miss the optimum

Machine machine(double jerk, double acceleration = 16000, double velocity = 1800) {
  return testing::equal_axes(2, velocity, acceleration, jerk);
}

/// Plans, and has the verifier look at every limit.
TimeLaw law(const Contour& contour, const Machine& m, const JerkLimitedOptions& options = {}) {
  Progress progress;
  TimeLaw result = plan_jerk_limited(contour, m, options, progress).law;
  ContourVerifierInput input{contour, m, result, options.corner_angle, 3};
  input.path = options.path;
  for (const Check& check : verify_motion(input, progress).checks)
    EXPECT_TRUE(check.passed) << check_name(check) << ' ' << check.value << " > " << check.limit;
  return result;
}
double duration(const Contour& contour, const Machine& m, const JerkLimitedOptions& options = {}) {
  return law(contour, m, options).duration();
}

Contour line(Vec to, double feed = unlimited) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, feed);
  b.line(to);
  return b.finish();
}

Contour curve(bool backwards = false, double scale = 1) {
  std::vector<Vec> p{{0, 0, 0}, {10, 0, 0}, {25, 5, 0}, {20, 20, 0}, {5, 25, 0}, {8, 40, 0}, {30, 45, 0}};
  std::vector<double> knots{0, 0, 0, 0, 0.2, 0.5, 0.7, 1, 1, 1, 1};
  if (backwards) {
    std::reverse(p.begin(), p.end());
    std::reverse(knots.begin(), knots.end());
    for (double& k : knots) k = 1 - k;
  }
  for (Vec& x : p) x = scale * x;
  ContourBuilder b(2, p.front());
  b.block(Mode::cut, unlimited);
  b.nurbs(3, p, std::vector<double>(p.size(), 1.0), knots);
  return b.finish();
}

/// Rest to rest by seven phases of jerk J under V and A.
double double_s(double d, double V, double A, double J) {
  const double a = std::min({A, std::sqrt(V * J), std::cbrt(d * J * J / 2)});
  double v = std::min(V, (-a * a / J + std::sqrt(a * a * a * a / (J * J) + 4 * a * d)) / 2);
  v = std::max(v, a * a / J);
  return d / v + v / a + a / J;
}

TEST(JerkLimited, LineIsDoubleS) {
  for (const double d : {1e-3, 0.1, 1.0, 30.0, 500.0})
    for (const double J : {1e4, 1e6, 1e8}) {
      const double exact = double_s(d, 400, 16000, J);
      EXPECT_NEAR(duration(line({d, 0, 0}, 400), machine(J)), exact, 1e-9 * exact) << d << ' ' << J;
    }
}

TEST(JerkLimited, SolverAgreesWithDoubleS) {
  for (const double d : {0.1, 1.0, 30.0, 500.0})
    for (const double J : {1e5, 1e6, 1e7}) {
      ContourBuilder b(2, {});
      b.block(Mode::cut, 400);
      b.line({0.4 * d, 0, 0});
      b.line({d, 0, 0});  // two segments: not the closed form
      const double exact = double_s(d, 400, 16000, J), found = duration(b.finish(), machine(J));
      EXPECT_LE(found, exact * (1 + converged)) << d << ' ' << J;
      EXPECT_GE(found, exact * (1 - 1e-9)) << d << ' ' << J;
    }
}

TEST(JerkLimited, WithinHalfAPercentOfADirectSolution) {
  for (const reference::JerkCurve& curve : reference::jerk_curves()) {
    const double expected = curve.expected(), found = duration(curve.contour, curve.machine);
    EXPECT_NEAR(found, expected, 5e-3 * expected) << curve.text;
    EXPECT_LE(found, curve.fine * (1 + converged)) << curve.text;
  }
}

TEST(JerkLimited, TendsToTheAccelerationLimitedOptimum) {
  Progress progress;
  const double limit = plan_acceleration_limited(curve(), machine(unlimited), {}, progress).law.duration();
  double before = unlimited;
  for (const double J : {1e5, 1e6, 1e7, 1e8, 1e9}) {
    const double now = duration(curve(), machine(J));
    EXPECT_LT(now, before * (1 + converged));
    EXPECT_GT(now, limit * (1 - 1e-6));
    before = now;
  }
  EXPECT_NEAR(before, limit, converged * limit);
  EXPECT_NEAR(duration(curve(), machine(unlimited)), limit, converged * limit);
}

TEST(JerkLimited, OneAxisMayBeUnlimitedInJerk) {
  Machine m = machine(1e6);
  m.axes[1].jerk = unlimited;
  const double T = duration(curve(), m);
  EXPECT_LT(T, duration(curve(), machine(1e6)) * (1 + converged));
  EXPECT_GT(T, duration(curve(), machine(unlimited)) * (1 - converged));
}

/// A law slowed by 2 needs an eighth of the jerk. So eight times the jerk can do no better than halve the duration: a
/// duration that falls by more was too long before.
TEST(JerkLimited, EightTimesTheJerkHalvesTheDurationAtMost) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Random random(seed);
    std::vector<Vec> points{{}};
    for (int i = 0; i < 6; ++i) points.push_back({random.uniform(-20, 20), random.uniform(-20, 20), 0});
    ContourBuilder b(2, {});
    b.block(Mode::cut, unlimited);
    b.nurbs(3, points, std::vector<double>(points.size(), 1.0), {0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1});
    const Contour contour = b.finish();
    for (const double other : {1.0, 100.0, unlimited})  // times the jerk of x
      for (const double jerk : {1e4, 1e5, 1e6}) {
        const auto with = [&](double J) {
          Machine m = machine(J);
          m.axes[1].jerk = other * J;
          return duration(contour, m);
        };
        EXPECT_LE(with(jerk), 2.1 * with(8 * jerk)) << seed << ' ' << jerk << ' ' << other;
      }
  }
}

TEST(JerkLimited, SmallJerkScalesLikeItsCubeRoot) {
  const double T = duration(curve(), machine(1e3));
  EXPECT_NEAR(duration(curve(), machine(1.0)), 10 * T, 10 * converged * T);
}

TEST(JerkLimited, BackwardsAsLong) {
  const double T = duration(curve(), machine(1e6));
  EXPECT_NEAR(duration(curve(true), machine(1e6)), T, converged * T);
}

TEST(JerkLimited, AnotherUnitOfLength) {
  const double T = duration(curve(), machine(1e6));
  EXPECT_NEAR(duration(curve(false, 1024), machine(1024e6, 1024 * 16000.0, 1024 * 1800.0)), T, 1e-6 * T);
}

TEST(JerkLimited, PathLimitsHold) {
  JerkLimitedOptions options;
  options.path = {200, 3000, 1e5};
  const double T = duration(curve(), machine(1e6), options);  // the verifier checks them
  EXPECT_GT(T, duration(curve(), machine(1e6)));
  options.path = {unlimited, unlimited, 1e5};
  EXPECT_LT(duration(curve(), machine(1e6), options), T);
}

TEST(JerkLimited, CurvatureJumpIsPassedSlowly) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 400);
  b.line({30, 0, 0});
  b.arc({30, 10, 0}, {30, 5, 0}, true);
  b.line({0, 10, 0});
  const Contour slot = b.finish();
  const Machine m = machine(1e6);
  const TimeLaw found = law(slot, m);
  for (const LawPiece& p : found.pieces()) {
    if (p.segment == 0 || p.s > slot.path[p.segment].s0()) continue;
    // |Δh″| v² ≤ jerk · cycle time
    EXPECT_LE(p.v * p.v / 5, 1e6 * m.cycle_time * (1 + 1e-9));
    EXPECT_GT(p.v * p.v / 5, 0.9 * 1e6 * m.cycle_time);
  }
}

TEST(JerkLimited, FeedsOfBlocksHold) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 100);
  b.line({20, 0, 0});
  b.block(Mode::cut, 400);
  b.line({60, 0, 0});
  b.block(Mode::cut, 150);
  b.line({80, 0, 0});
  EXPECT_GT(duration(b.finish(), machine(1e6)), 20 / 100.0 + 40 / 400.0 + 20 / 150.0);  // the verifier checks the feeds
}

// Far from every limit but the feed nothing happens: a line there is one piece of the law, and no line loses by that.
TEST(JerkLimited, LinesPassedAtTheFeedAreOnePieceEach) {
  const auto planned = [](int lines) {
    ContourBuilder b(2, {});
    b.block(Mode::cut, 2);
    for (int i = 1; i <= lines; ++i) b.line({static_cast<double>(i), 0.3 * static_cast<double>(i % 2), 0});
    JerkLimitedOptions options;
    options.corner_angle = 1;  // corners of 0.6 rad are passed, within what a cycle allows
    Machine m = machine(1e6);
    m.cycle_time = 0.01;
    return law(b.finish(), m, options);
  };
  const TimeLaw few = planned(100), many = planned(300);
  const double time = 200 * std::hypot(1.0, 0.3) / 2;
  EXPECT_NEAR(many.duration() - few.duration(), time, 3e-5 * time);  // the solver keeps 2e-5 of each limit
  EXPECT_LE(many.pieces().size() - few.pieces().size(), 220u);
}

// Where a slow block ends the motion gathers speed as early as it can, however long the cells behind it are.
TEST(JerkLimited, LeavesASlowBlockAccelerating) {
  const auto planned = [](int pieces) {
    ContourBuilder b(2, {});
    b.block(Mode::cut, 20);
    b.line({10, 0, 0});
    b.block(Mode::cut, 150);
    for (int i = 1; i <= pieces; ++i) b.line({10 + 400.0 * i / pieces, 0, 0});
    return duration(b.finish(), machine(2500, 450));
  };
  const double in_pieces = planned(200);
  EXPECT_NEAR(planned(1), in_pieces, 5e-4 * in_pieces);
}

TEST(JerkLimited, CuspsAndCorners) {
  ContourBuilder b(2, {});
  b.polynomial({{0, 0, 10}, {0, 0, 0, 10}});  // (u², u³): starts in a cusp
  b.line({10, 30, 0});
  b.line({-5, 30, 0});
  EXPECT_NEAR(duration(b.finish(), machine(1e6)), 0.243065, 0.243065 * converged);
}

TEST(JerkLimited, Micrometres) {
  ContourBuilder b(2, {});
  b.arc({1e-3, 1e-3, 0}, {0, 1e-3, 0}, true);
  EXPECT_NEAR(duration(b.finish(), machine(1e6)), 0.003917259, 0.003917259 * converged);
}

TEST(JerkLimited, StopsWhenAsked) {
  struct Impatient final : ProgressSink {
    void report(std::string_view, double, std::string_view) override { throw Stopped(StopReason::cancelled); }
  } impatient;
  EXPECT_THROW(plan_jerk_limited(curve(), machine(1e6), {}, impatient), Stopped);
}

TEST(JerkLimited, RefusesLimitsThatAreNone) {
  Progress progress;
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(plan_jerk_limited(curve(), machine(bad), {}, progress), InvalidInput);
    JerkLimitedOptions options;
    options.path.jerk = bad;
    EXPECT_THROW(plan_jerk_limited(curve(), machine(1e6), options, progress), InvalidInput);
  }
}

TEST(JerkLimited, SameInputSameBits) {
  testing::expect_same_bits(law(curve(), machine(1e6)), law(curve(), machine(1e6)));
}

}  // namespace
}  // namespace bahnwerk
