#include "core/verify/redundant/reachable_states.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

ReachableStates at_rest(double x) { return ReachableStates::box(x, x, 0); }

TEST(ReachableStates, HoldWhateverMotionLeadsTo) {
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    ReachableStates states = ReachableStates::box(-0.3, 0.4, 0.2);
    double x = random.uniform(-0.3, 0.4), v = random.uniform(-0.2, 0.2);
    const double acceleration = random.uniform(0.5, 2);
    for (int step = 0; step < 200; ++step) {
      const double h = random.uniform(0.01, 0.2);
      // Three accelerations in one step, mostly at the limits.
      for (double left = h; left > 0;) {
        const double t = std::min(left, random.uniform(0.1, 1) * h);
        const double a = acceleration * std::clamp(random.uniform(-2, 2), -1.0, 1.0);
        x += t * (v + 0.5 * t * a);
        v += t * a;
        left -= t;
      }
      states.advance(h, infinite, acceleration);
      const double room = random.uniform(0, 0.5);
      states.limit(x - room, x + 1 - room, std::abs(v) + random.uniform(0, 0.5));
      ASSERT_TRUE(states.holds(x, v)) << round << ' ' << step;
    }
  }
}

TEST(ReachableStates, ScaledVelocitiesAreAmongThem) {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    const double x = random.uniform(-1, 1), v = random.uniform(-1, 1), factor = random.uniform(1, 1.5);
    ReachableStates states = ReachableStates::box(x, x + 0.1, std::abs(v));
    states.advance(random.uniform(0.01, 0.5), infinite);
    states.limit(-2, 2, std::abs(v));
    const double fastest = states.holds(x, v) ? std::abs(v) : 0;
    states.scale_velocity(factor);
    if (fastest == 0) continue;
    for (const double by : {1 / factor, 1.0, 0.5 * (1 + factor), factor}) EXPECT_TRUE(states.holds(x, by * v)) << round;
    EXPECT_FALSE(states.holds(x, 1.01 * (2 * factor - 1) * fastest));
  }
}

TEST(ReachableStates, FromRestNothingGetsFurtherThanFullAcceleration) {
  ReachableStates states = at_rest(0);
  for (int i = 0; i < 20; ++i) states.advance(0.1, infinite);
  EXPECT_TRUE(states.holds(2, 2));
  EXPECT_FALSE(states.holds(2 + 1e-6, 2));
  EXPECT_FALSE(states.holds(2, 1.8));
  EXPECT_TRUE(states.holds(1, 0));  // there and stopped: T = 2 √d
  EXPECT_FALSE(states.holds(1 + 5e-3, 0));
}

TEST(ReachableStates, AMoveFromRestToRestTakesItsLeastTime) {
  for (const double velocity : {0.4, infinite}) {
    const double least = velocity < 1 ? 1 / velocity + velocity : 2.0;
    for (const double factor : {0.995, 1.001}) {
      ReachableStates states = at_rest(0);
      for (int i = 0; i < 40; ++i) states.advance(least * factor / 40, velocity);
      states.limit(at_rest(1));
      EXPECT_EQ(states.empty(), factor < 1) << velocity;
    }
  }
}

TEST(ReachableStates, SumsAndDifferencesHoldThoseOfTheirStates) {
  Random random(2);
  ReachableStates a = ReachableStates::box(0, 1, 2), b = ReachableStates::box(-1, 0, 0.5);
  for (int i = 0; i < 20; ++i) a.advance(0.1, infinite), b.advance(0.1, infinite, 3);
  const ReachableStates sum = a.plus(b), difference = a.subtracted_from(5), turned = b.reversed();
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = random.uniform(-3, 8), v = random.uniform(-5, 5), y = random.uniform(-10, 10),
                 w = random.uniform(-8, 8);
    EXPECT_EQ(difference.holds(5 - x, -v), a.holds(x, v));
    EXPECT_EQ(turned.holds(y, -w), b.holds(y, w));
    if (!a.holds(x, v) || !b.holds(y, w)) continue;
    ++inside;
    EXPECT_TRUE(sum.holds(x + y, v + w));
  }
  EXPECT_GT(inside, 50);
  EXPECT_FALSE(sum.holds(100, 0));
}

}  // namespace
}  // namespace bahnwerk
