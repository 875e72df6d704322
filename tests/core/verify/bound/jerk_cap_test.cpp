// What jerk leaves of b on a piece: never less than a motion within the limits has, and close to it where curvature
// sets in.
#include "core/verify/bound/jerk_cap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace bahnwerk::verify {
namespace {

/// Two axes along a plane curve of heading θ(s) = θ₀ + κ s + κ′ s²/2 + κ″ s³/6, and a third one that is a polynomial.
struct Curve {
  double heading = 0, q2 = 0, rate = 0, change = 0;
  std::array<double, 4> third{};

  struct At {
    std::array<double, 3> d1, d2, d3;
  };
  At at(double s) const {
    const double o = heading + s * (q2 + s * (rate / 2 + s * change / 6)), k = q2 + s * (rate + s * change / 2),
                 r = rate + s * change, x = std::cos(o), y = std::sin(o);
    return {{x, y, third[1] + s * (2 * third[2] + 3 * s * third[3])},
            {-k * y, k * x, 2 * third[2] + 6 * s * third[3]},
            {-r * y - k * k * x, r * x - k * k * y, 6 * third[3]}};
  }
};

/// From s = 0 to `length`; limits are left open, and how axes go on is unknown.
template <int N>
JerkCapPiece<N> piece_of(const Curve& curve, double length) {
  JerkCapPiece<N> p;
  p.length = length, p.rounding_error = 1e-15, p.unit = N == 2;
  constexpr int samples = 400;
  for (std::size_t k = 0; k < N; ++k) {
    p.tangent[0][k] = curve.at(0).d1[k], p.tangent[1][k] = curve.at(length).d1[k];
    p.q2[0][k] = curve.at(0).d2[k], p.q2[1][k] = curve.at(length).d2[k];
    double low = 1e9, high = -1e9, way = 0;
    for (int i = 0; i <= samples; ++i) {
      const double t = curve.at(length * i / samples).d1[k];
      low = std::min(low, t), high = std::max(high, t);
      way += (i == 0 || i == samples ? 0.5 : 1) * t * length / samples;
    }
    p.least[k] = std::max({0.0, low - 1e-6, -high - 1e-6}), p.most[k] = std::max(high, -low) + 1e-6;
    p.displacement[k] = std::abs(way) + 1e-6 * length;
  }
  return p;
}

template <int N>
void expect_no_motion_above(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> sign(-1, 1), part(0, 1);
  int limited = 0;
  for (int i = 0; i < 4000; ++i) {
    const double length = std::pow(10, -2 * part(random));
    Curve curve{3 * sign(random),
                0.3 * sign(random) / length,
                0.5 * sign(random) / (length * length),
                sign(random) / (length * length * length),
                {}};
    if (i % 3 == 0) curve.q2 = curve.change = 0;
    curve.third = {0, sign(random), sign(random) / length, sign(random) / (length * length)};
    JerkCapPiece<N> p = piece_of<N>(curve, length);
    // Through the piece with v = v₀ + a t + j t²/2.
    const double v0 = 10, time = length / v0, a = 0.2 * sign(random) * v0 / time,
                 j = 0.2 * sign(random) * v0 / (time * time);
    double most = 0;
    std::array<double, N> acceleration{}, jerk{};
    for (double t = 0, s = 0; s < length; t += time / 400) {
      const double v = v0 + t * (a + t * j / 2), along = a + t * j;
      s = t * (v0 + t * (a / 2 + t * j / 6));
      const Curve::At at = curve.at(std::min(s, length));
      most = std::max(most, v * v);
      for (std::size_t k = 0; k < N; ++k) {
        acceleration[k] = std::max(acceleration[k], std::abs(at.d2[k] * v * v + at.d1[k] * along));
        jerk[k] = std::max(jerk[k], std::abs(at.d3[k] * v * v * v + 3 * at.d2[k] * v * along + at.d1[k] * j));
      }
    }
    for (std::size_t k = 0; k < N; ++k) p.acceleration[k] = 1.01 * acceleration[k], p.jerk[k] = 1.01 * jerk[k];
    const JerkCap found = jerk_cap(p, 1e8);
    ASSERT_GE(found.cap, most * (1 - 1e-4)) << i;
    EXPECT_TRUE(found.cap == 1e8 || jerk_may_limit(p, 1e8)) << i;
    limited += found.cap < 1e8;
  }
  EXPECT_GT(limited, 400);
}

TEST(JerkCap, NoMotionWithinTheLimitsIsFaster) {
  expect_no_motion_above<2>(1);
  expect_no_motion_above<3>(2);
}

// Where curvature sets in, κ = 0, the jerk across the path is κ′ v³.
TEST(JerkCap, IsWhatTheRateOfCurvatureAllows) {
  for (const double rate : {1.0, 50.0, 2000.0}) {
    const double jerk = 1e5, cap = std::pow(jerk / rate, 2.0 / 3);
    const double length = 0.01 / std::sqrt(rate);
    JerkCapPiece<2> p = piece_of<2>({0, -rate * length / 2, rate, 0, {}}, length);
    p.acceleration = {1e4, 1e4}, p.jerk = {jerk, jerk};
    const JerkCap found = jerk_cap(p, 1e6);
    EXPECT_GE(found.cap, cap) << rate;
    EXPECT_LE(found.cap, cap * 1.03 + 2 * found.change) << rate;
  }
}

TEST(JerkCap, ConstantCurvatureAndAxesWithoutLimitsSayNothing) {
  JerkCapPiece<2> p = piece_of<2>({0.3, 2, 0, 0, {}}, 0.01);
  p.acceleration = {1e4, 1e4}, p.jerk = {1e5, 1e5};
  EXPECT_EQ(jerk_cap(p, 1e4).cap, 1e4);
  p = piece_of<2>({0.3, 0, 1000, 0, {}}, 0.01);
  p.acceleration = {1e4, 1e4}, p.jerk = {1e5, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(jerk_cap(p, 1e6).cap, 1e6);
}

// Any motion of an axis that does not turn round on its way: its jerk switches at random, and is what takes it to rest
// in the end.
TEST(JerkCap, AnAxisThatGoesOnBrakesNoHarder) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  int close = 0;
  for (int i = 0; i < 2000; ++i) {
    const double jerk = 1000, way = std::pow(10, 2 * part(random) - 1), u0 = 30 * part(random), y0 = 300 * part(random);
    // The hardest that can be done against turning round: y falls by jerk all the time.
    double u = u0, y = y0, x = 0;
    const double dt = 1e-4;
    while (x < way && u > 0 && y > 0) {
      x += dt * (u - dt * y / 2);
      u -= dt * (y - dt * jerk / 2), y -= dt * jerk;
    }
    if (u <= 0 && x < 0.999 * way) continue;  // it turns round before
    const double most = most_braking(u0, jerk, {way, 0});
    EXPECT_LE(y0, most * (1 + 1e-3)) << u0 << ' ' << way;
    EXPECT_LE(y0 + 7, most_braking(u0, jerk, {way, 7}) * (1 + 1e-3));
    // What is left of y at the end of the way, or before at rest, tells as much.
    const double end = std::max(y, 0.0);
    EXPECT_LE(y0, most_braking(u0, jerk, {way, 0, end}) * (1 + 1e-3)) << u0 << ' ' << way << ' ' << end;
    EXPECT_LE(most_braking(u0, jerk, {way, 0, end}), most * (1 + 1e-12));
    close += y0 > 0.7 * most;
  }
  EXPECT_GT(close, 20);
}

}  // namespace
}  // namespace bahnwerk::verify
