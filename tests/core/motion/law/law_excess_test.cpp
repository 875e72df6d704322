// By how much a law exceeds its limits, between samples, too.
#include "core/motion/law/law_excess.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/motion/law/law_between.hpp"
#include "core/numeric/random.hpp"
#include "core/verify/law/verifier.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

struct Driven {
  Path tool;
  std::unique_ptr<CartesianAxisPath> axes;
  Machine machine{{{"x", 1, 1, 1}, {"y", 1, 1, 1}}, 0.001};
  TimeLaw law;
  Limits along;
  std::vector<bool> rests;
  void done() {
    axes = std::make_unique<CartesianAxisPath>(tool, 2);
    rests.assign(tool.size() + 1, false);
    rests.front() = rests.back() = true;
  }
  void limit(double velocity, double acceleration, double jerk) {
    for (AxisLimits& axis : machine.axes) axis.velocity = velocity, axis.acceleration = acceleration, axis.jerk = jerk;
  }
  double excess() const {
    Progress silent;
    ProgressScope progress(silent, "test");
    const PathTask task{*axes, machine, std::vector<double>(tool.size(), unlimited), rests};
    return law_excess(task, law, along, progress);
  }
};

/// Along a line of 1 mm by s = 3 t² − 2 t³: v ≤ 1.5, |a| ≤ 6, j = −12.
Driven line() {
  Driven driven;
  driven.tool.append(std::make_shared<Line>(Vec{0, 0}, Vec{1, 0}), 0);
  driven.done();
  LawPiece piece;
  piece.duration = 1, piece.s_end = 1, piece.a = 6, piece.j = -12;
  driven.law.append(piece);
  return driven;
}

TEST(LawExcess, IsTheWorstRatioToItsRoot) {
  Driven driven = line();
  driven.limit(1e9, 1e9, 1e9);
  driven.machine.axes[0].velocity = 0.5;
  EXPECT_NEAR(driven.excess(), 3, 1e-6);
  driven.machine.axes[0].acceleration = 6.0 / 16;
  EXPECT_NEAR(driven.excess(), 4, 1e-6);
  driven.machine.axes[0].jerk = 12.0 / 125;
  EXPECT_NEAR(driven.excess(), 5, 1e-6);
}

TEST(LawExcess, CountsLimitsAlongThePathAndFeeds) {
  Driven driven = line();
  driven.limit(1e9, 1e9, 1e9);
  driven.along.velocity = 0.75;
  EXPECT_NEAR(driven.excess(), 2, 1e-12);
  driven.along.acceleration = 6.0 / 9;
  EXPECT_NEAR(driven.excess(), 3, 1e-12);
  driven.along.jerk = 12.0 / 64;
  EXPECT_NEAR(driven.excess(), 4, 1e-12);
}

/// Evenly round a circle of radius r: the axes' peaks v, v²/r, v³/r² lie at no end and in no middle of the piece.
TEST(LawExcess, FindsPeaksBetweenSamples) {
  constexpr double r = 3, v = 7;
  Driven driven;
  driven.tool.append(
      std::make_shared<Arc>(Vec{}, Vec{std::cos(0.3), std::sin(0.3)}, Vec{-std::sin(0.3), std::cos(0.3)}, r, 5.9), 0);
  driven.done();
  LawPiece piece;
  piece.v = v, piece.s_end = driven.axes->length(), piece.duration = piece.s_end / v;
  driven.law.append(piece);
  driven.limit(v / 1.5, 1e9, 1e9);
  EXPECT_NEAR(driven.excess(), 1.5, 1e-6);
  driven.limit(1e9, v * v / r / 4, 1e9);
  EXPECT_NEAR(driven.excess(), 2, 1e-6);
  driven.limit(1e9, 1e9, v * v * v / (r * r) / 27);
  EXPECT_NEAR(driven.excess(), 3, 1e-6);
}

/// From a line into an arc at constant speed q″ jumps by 1/r.
TEST(LawExcess, CountsTheStepsAtJoints) {
  constexpr double r = 2, v = 5;
  Driven driven;
  driven.tool.append(std::make_shared<Line>(Vec{-10, -r}, Vec{0, -r}), 0);
  driven.tool.append(std::make_shared<Arc>(Vec{}, Vec{0, -1}, Vec{1, 0}, r, 0.5), 1);
  driven.done();
  driven.limit(1e9, 1e9, 1e9);
  for (std::size_t i = 0; i < 2; ++i) {
    LawPiece piece;
    piece.segment = i, piece.v = v;
    piece.s = driven.tool[i].s0(), piece.s_end = driven.tool[i].s1(), piece.duration = driven.tool[i].length() / v;
    driven.law.append(piece);
  }
  const double jump = v * v / r;
  driven.machine.axes[1].jerk = jump / driven.machine.cycle_time / 9;
  // The jerk on the arc itself, v³/r², is far less.
  EXPECT_NEAR(driven.excess(), 3, 1e-9);
  driven.rests[1] = true;
  EXPECT_LT(driven.excess(), 1);
}

/// Slowed by its excess a law is verified up to 1e-6, and no more than that slower than need be.
TEST(LawExcessProperty, IsWhatTheVerifierFinds) {
  Random random(3);
  for (int n = 0; n < testing::cases(60); ++n) {
    Driven driven;
    std::vector<Vec> points;
    for (int i = 0; i < 6; ++i) points.push_back({4.0 * i + random.uniform(-1, 1), random.uniform(-4, 4)});
    driven.tool.append(std::make_shared<Rational>(Rational::bezier(points)), 0);
    driven.done();
    for (AxisLimits& axis : driven.machine.axes) {
      axis.velocity = std::pow(10, random.uniform(1, 2));
      axis.acceleration = std::pow(10, random.uniform(1, 3));
      axis.jerk = std::pow(10, random.uniform(2, 4));
    }
    // From rest to rest by a cosine's speed, in few pieces, so that samples of them tell little.
    const double length = driven.axes->length();
    const int pieces = 2 + static_cast<int>(random.uniform(0, 8));
    LawState from{};
    for (int i = 1; i <= pieces; ++i) {
      const double x = 2 * std::numbers::pi * i / pieces;
      LawState to{length * (x - std::sin(x)) / (2 * std::numbers::pi), length * (1 - std::cos(x)),
                  length * 2 * std::numbers::pi * std::sin(x)};
      if (i == pieces) to = {length, 0, 0};
      append_between(driven.law, 0, from, to, 1.0 / pieces);
      from = to;
    }
    driven.law.slow(driven.excess());
    VerifierInput input{*driven.axes, driven.machine, driven.law, {unlimited}, driven.rests};
    input.order = 3;
    Progress silent;
    double most = 0;
    for (const Check& check : verify_motion(input, silent).checks) {
      const double ratio = check.value / check.limit;
      if (check_name(check).starts_with("velocity x") || check_name(check).starts_with("velocity y"))
        most = std::max(most, ratio);
      if (check_name(check).starts_with("acceleration x") || check_name(check).starts_with("acceleration y"))
        most = std::max(most, std::sqrt(ratio));
      if (check_name(check).starts_with("jerk ")) most = std::max(most, std::cbrt(ratio));
    }
    EXPECT_NEAR(most, 1, 1e-6) << n;
  }
}

}  // namespace
}  // namespace bahnwerk
