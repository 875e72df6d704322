/// What holds for every straight move, on random ones over many magnitudes.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "core/motion/profile/profile.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk {
namespace {

double magnitude(Random& random, double low = 1e-6, double high = 1e6) {
  return std::exp(random.uniform(std::log(low), std::log(high)));
}

struct Case {
  double length, v0, v1;
  Limits limits;
};

/// Limits, speeds and lengths of 1e-6 … 1e6 and of every kind; a third of the lengths just above the direct change,
/// some between it and the least.
Case random_case(Random& random) {
  Case c{};
  auto maybe = [&] { return random.chance(0.2) ? unlimited : magnitude(random); };
  c.limits = {maybe(), maybe(), maybe(), maybe()};
  if (c.limits.acceleration == unlimited && c.limits.jerk == unlimited && c.limits.snap == unlimited)
    c.limits.jerk = magnitude(random);
  const double fast = std::min(c.limits.velocity, 1e6);
  auto speed = [&] {
    switch (random.below(5)) {
      case 0:
        return 0.0;
      case 1:
        return fast;
      case 2:
        return fast * random.uniform();
      default:
        return fast * magnitude(random, 1e-9, 1);
    }
  };
  c.v0 = speed();
  c.v1 = random.chance(0.15) ? c.v0 : speed();
  const double direct = direct_distance(c.v0, c.v1, c.limits), least = min_distance(c.v0, c.v1, c.limits);
  switch (random.below(6)) {
    case 0:
      c.length = direct;
      break;
    case 1:
      c.length = direct * (1 + magnitude(random, 1e-15, 1));
      break;
    case 2:
      c.length = least + (direct - least) * random.uniform();
      break;
    default:
      c.length = direct + magnitude(random) * std::min(1.0, fast);
      break;
  }
  return c;
}

::testing::AssertionResult near(double a, double b, double tolerance, const char* what) {
  if (std::abs(a - b) <= tolerance) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << what << ": " << a << " and " << b << " differ by " << a - b;
}

/// Joints, ends and limits of a move, to 1e-12 of its own size.
void expect_sound(const Case& c, const Profile& p) {
  const Limits& l = c.limits;
  const double s1 = 1e-12 * c.length, v1 = 1e-12 * p.peak_speed, a1 = 1e-12 * p.peak_acceleration;
  const double j1 = l.snap < unlimited ? 1e-12 * p.peak_jerk : unlimited;
  const double a_joint = l.snap < unlimited || l.jerk < unlimited ? a1 : unlimited;
  ASSERT_LE(p.count, 15u);
  ASSERT_LE(p.peak_speed, l.velocity);
  ASSERT_LE(p.peak_acceleration, l.acceleration * (1 + 1e-12));
  if (a_joint < unlimited) {
    ASSERT_LE(p.peak_jerk, l.jerk * (1 + 1e-12));
  }
  ProfileState at{0, c.v0, 0, 0, 0};
  double t = 0;
  for (const ProfilePiece& q : p.pieces()) {
    ASSERT_TRUE(near(q.t0, t, 1e-14 * p.duration, "t"));
    ASSERT_TRUE(near(q.s, at.s, s1, "s"));
    ASSERT_TRUE(near(q.v, at.v, v1, "v"));
    ASSERT_TRUE(near(q.a, at.a, a_joint, "a"));
    ASSERT_TRUE(near(q.j, at.j, j1, "j"));
    ASSERT_GT(q.duration, 0);
    ASSERT_TRUE(q.snap == 0 || std::abs(q.snap) == l.snap);
    // a and v are monotone between the ends of a piece: a keeps its sign, j too.
    at = q.at(q.duration);
    for (const ProfileState& x : {q.at(0), at}) {
      ASSERT_GE(x.v, -v1);
      ASSERT_LE(x.v, l.velocity + v1);
      ASSERT_LE(std::abs(x.a), p.peak_acceleration + a1);
      if (a_joint < unlimited) {
        ASSERT_LE(std::abs(x.j), p.peak_jerk * (1 + 1e-12));
      }
    }
    ASSERT_GE(q.at(0).a * at.a, -a1 * p.peak_acceleration);
    ASSERT_GE(q.at(0).j * at.j, -1e-12 * p.peak_jerk * p.peak_jerk);
    t += q.duration;
  }
  ASSERT_TRUE(near(at.s, c.length, s1, "s at the end"));
  ASSERT_TRUE(near(at.v, c.v1, v1, "v at the end"));
  ASSERT_TRUE(near(at.a, 0, a_joint, "a at the end"));
  ASSERT_TRUE(near(at.j, 0, j1, "j at the end"));
  if (p.count > 0) {
    ASSERT_EQ(p.sample(0).s, 0);
    ASSERT_EQ(p.sample(0).v, c.v0);
  }
  ASSERT_EQ(p.sample(p.duration).s, c.length);
  ASSERT_EQ(p.sample(p.duration).v, c.v1);
}

std::string text(const Case& c) {
  std::ostringstream out;
  out.precision(17);
  out << "length " << c.length << " speeds " << c.v0 << " " << c.v1 << " limits " << c.limits.velocity << " "
      << c.limits.acceleration << " " << c.limits.jerk << " " << c.limits.snap;
  return out.str();
}

TEST(ProfileProperty, JointsEndsAndLimits) {
  Random random(41);
  std::size_t dips = 0, holds = 0;
  for (int run = 0; run < testing::cases(100000); ++run) {
    const Case c = random_case(random);
    SCOPED_TRACE(text(c));
    const Profile p = straight_profile(c.length, c.v0, c.v1, c.limits);
    expect_sound(c, p);
    if (HasFatalFailure()) return;
    dips += p.turning_speed < std::min(c.v0, c.v1);
    holds += p.turning_speed == c.limits.velocity;
  }
  EXPECT_GT(200 * dips, testing::cases(std::size_t{100000}));
  EXPECT_GT(10 * holds, testing::cases(std::size_t{100000}));
}

/// The same numbers in other units, by powers of two.
TEST(ProfileProperty, Scales) {
  Random random(42);
  for (int run = 0; run < testing::cases(10000); ++run) {
    const Case c = random_case(random);
    if (c.length < direct_distance(c.v0, c.v1, c.limits)) continue;  // dips are sensitive to the last bit of length
    const double x = 8, t = 0.5;                                     // new units of length and time
    const Limits& l = c.limits;
    const double v = x / t, a = v / t, j = a / t, s = j / t;
    const Profile p = straight_profile(c.length, c.v0, c.v1, l);
    const Profile q = straight_profile(c.length * x, c.v0 * v, c.v1 * v,
                                       {l.velocity * v, l.acceleration * a, l.jerk * j, l.snap * s});
    ASSERT_NEAR(q.duration, p.duration * t, 1e-13 * q.duration) << text(c);
  }
}

TEST(ProfileProperty, RunsBackwardsInTheSameTime) {
  Random random(43);
  for (int run = 0; run < testing::cases(20000); ++run) {
    const Case c = random_case(random);
    if (c.length < direct_distance(c.v0, c.v1, c.limits)) continue;
    const Profile p = straight_profile(c.length, c.v0, c.v1, c.limits);
    const Profile q = straight_profile(c.length, c.v1, c.v0, c.limits);
    ASSERT_NEAR(q.duration, p.duration, 1e-14 * p.duration) << text(c);
    ASSERT_EQ(q.turning_speed, p.turning_speed);
    const double t = p.duration * random.uniform();
    const ProfileState a = p.sample(t), b = q.sample(p.duration - t);
    ASSERT_NEAR(b.s, c.length - a.s, 1e-13 * (c.length + p.peak_speed * p.duration)) << text(c);
  }
}

/// Longer takes longer, weaker takes longer.
TEST(ProfileProperty, Monotone) {
  Random random(44);
  for (int run = 0; run < testing::cases(20000); ++run) {
    const Case c = random_case(random);
    if (c.length < direct_distance(c.v0, c.v1, c.limits)) continue;
    const double T = straight_profile(c.length, c.v0, c.v1, c.limits).duration, margin = 1 + 1e-13;
    ASSERT_GE(straight_profile(c.length * (1 + magnitude(random, 1e-12, 10)), c.v0, c.v1, c.limits).duration * margin,
              T)
        << text(c);
    const double more = 1 + magnitude(random, 1e-12, 10);
    for (double Limits::*limit : {&Limits::velocity, &Limits::acceleration, &Limits::jerk, &Limits::snap}) {
      Limits stronger = c.limits;
      stronger.*limit *= more;
      ASSERT_LE(straight_profile(c.length, c.v0, c.v1, stronger).duration, T * margin) << text(c);
    }
  }
}

/// A limit far away is none; each kind of move is the limit of the next.
TEST(ProfileProperty, FarLimitsDoNotCount) {
  Random random(45);
  for (int run = 0; run < testing::cases(20000); ++run) {
    Limits l{magnitude(random, 0.1, 10), magnitude(random, 0.1, 10), unlimited, unlimited};
    const double v0 = l.velocity * random.uniform(), v1 = random.chance(0.3) ? v0 : l.velocity * random.uniform();
    const double length = direct_distance(v0, v1, l) * (1 + random.uniform()) + magnitude(random, 0.01, 10);
    auto T = [&](const Limits& x) { return straight_profile(length, v0, v1, x).duration; };
    const double trapezoid = T(l);
    Limits stiff = l;
    stiff.jerk = 1e9;
    ASSERT_NEAR(T(stiff), trapezoid, 2e-7 * (1 + trapezoid));
    l.jerk = magnitude(random, 10, 100);
    if (direct_distance(v0, v1, l) > 0.99 * length) continue;
    const double smooth = T(l);
    ASSERT_GE(smooth, trapezoid);
    stiff = l;
    stiff.snap = 1e13;
    ASSERT_NEAR(T(stiff), smooth, 1e-6 * smooth);
    stiff = l;
    stiff.velocity = 1e9;
    ASSERT_LE(T(stiff), smooth * (1 + 1e-13));
  }
}

/// Between any two moves no less than the direct change, along a ray through all the cases between them: the half in
/// which the duration changes more is halved again and again. A jump would survive; a cube root does not.
TEST(ProfileProperty, ContinuousAcrossTheCases) {
  Random random(46);
  struct Move {
    double spare, low, rise, velocity, acceleration, jerk, snap;
  };
  for (int run = 0; run < testing::cases(3000); ++run) {
    auto any = [&] { return magnitude(random, 0.1, 10); };
    auto move = [&]() -> Move {
      return {random.chance(0.2) ? 0 : any(), any(), random.chance(0.3) ? 0 : any(), any(), any(), any(), any()};
    };
    const Move a = move(), b = move();
    const bool jerk = random.chance(0.7), snap = random.chance(0.5), backwards = random.chance(0.5);
    auto duration = [&](double x) {
      auto at = [&](double Move::*field) { return (1 - x) * a.*field + x * b.*field; };
      const double v0 = at(&Move::low), v1 = v0 + at(&Move::rise);
      const Limits l{v1 + at(&Move::velocity) - 0.1, at(&Move::acceleration), jerk ? at(&Move::jerk) : unlimited,
                     snap ? at(&Move::snap) : unlimited};
      const double length = direct_distance(v0, v1, l) + at(&Move::spare);
      return straight_profile(length, backwards ? v1 : v0, backwards ? v0 : v1, l).duration;
    };
    double left = 0, right = random.uniform(), T_left = duration(left), T_right = duration(right);
    for (int i = 0; i < 50; ++i) {
      const double middle = (left + right) / 2, T = duration(middle);
      const bool first = std::abs(T - T_left) > std::abs(T_right - T);
      (first ? right : left) = middle;
      (first ? T_right : T_left) = T;
    }
    ASSERT_NEAR(T_left, T_right, 1e-4 * (1 + T_left)) << "run " << run << " at " << left;
  }
}

}  // namespace
}  // namespace bahnwerk
