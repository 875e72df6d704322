#include "core/motion/profile/profile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

double duration(double length, const Limits& limits) { return straight_profile(length, 0, 0, limits).duration; }

TEST(Profile, TrapezoidByHand) {
  const Profile p = straight_profile(100, 0, 0, {10, 5});
  EXPECT_DOUBLE_EQ(p.duration, 100 / 10. + 10 / 5.);
  ASSERT_EQ(p.count, 3u);
  EXPECT_DOUBLE_EQ(p.sample(1).v, 5);
  EXPECT_DOUBLE_EQ(p.sample(6).s, 50);
  EXPECT_DOUBLE_EQ(p.sample(11).a, -5);
  EXPECT_DOUBLE_EQ(duration(0.8, {10, 5}), 2 * std::sqrt(0.8 / 5));
  // From 3 to 1 over 2 mm: w² = (9 + 1)/2 + 5·2.
  const Profile q = straight_profile(2, 3, 1, {10, 5});
  const double w = std::sqrt(15.0);
  EXPECT_DOUBLE_EQ(q.turning_speed, w);
  EXPECT_DOUBLE_EQ(q.duration, (w - 3) / 5 + (w - 1) / 5);
  EXPECT_DOUBLE_EQ(q.peak_acceleration, 5);
}

TEST(Profile, DoubleSByHand) {
  EXPECT_DOUBLE_EQ(duration(100, {10, 5, 20}), 100 / 10. + 10 / 5. + 5 / 20.);
  EXPECT_EQ(straight_profile(100, 0, 0, {10, 5, 20}).count, 7u);
  EXPECT_DOUBLE_EQ(duration(0.01, {10, 5, 20}), 4 * std::cbrt(0.01 / (2 * 20)));
  EXPECT_EQ(straight_profile(0.01, 0, 0, {10, 5, 20}).count, 4u);
  // Speed limit reached, acceleration limit not: T = L/V + 2 √(V/J).
  EXPECT_DOUBLE_EQ(duration(10, {1, 50, 20}), 10 / 1. + 2 * std::sqrt(1 / 20.));
  // Acceleration limit reached, speed limit not: w (w/A + A/J) = L.
  const double w = 0.5 * (-1.25 + std::sqrt(1.25 * 1.25 + 4 * 5 * 5.0));
  EXPECT_DOUBLE_EQ(duration(5, {10, 5, 20}), 2 * (w / 5 + 0.25));
}

TEST(Profile, SnapLimitedByHand) {
  EXPECT_DOUBLE_EQ(duration(100, {10, 5, 20, 100}), 100 / 10. + 10 / 5. + 5 / 20. + 20 / 100.);
  EXPECT_EQ(straight_profile(100, 0, 0, {10, 5, 20, 100}).count, 15u);
  // Eight ramps of τ: w = 2 S τ³, L = 8 S τ⁴.
  EXPECT_DOUBLE_EQ(duration(0.0008, {10, 5, 20, 100}), 8 * std::pow(0.0008 / (8 * 100), 0.25));
  EXPECT_DOUBLE_EQ(duration(1, {unlimited, unlimited, unlimited, 8}), 8 * std::pow(1 / 64., 0.25));
  // Jerk limit reached, the others not: a(a/J + J/S) = w, L = 2 w (a/J + J/S), with a = 1, J = 2, S = 8.
  const double half = 1 / 2. + 2 / 8.;
  EXPECT_DOUBLE_EQ(duration(2 * half * half, {9, 9, 2, 8}), 4 * half);
}

TEST(Profile, DurationIsContinuousAtTheBordersOfTheCases) {
  // Speed and acceleration limit reached just so.
  EXPECT_DOUBLE_EQ(duration(20, {10, 5}), 4);
  EXPECT_DOUBLE_EQ(duration(10 * (10 / 5. + 5 / 20.), {10, 5, 20}), 2 * (10 / 5. + 5 / 20.));
  EXPECT_DOUBLE_EQ(duration(1.25 * 0.5, {10, 5, 20}), 4 * 5 / 20.);
  EXPECT_DOUBLE_EQ(straight_profile(5, 0, 5, {5, unlimited, 5}).duration, 2);
}

TEST(Profile, DirectChange) {
  const Limits limits{100, 5, 20, 50};
  for (const auto& [v0, v1] : {std::pair{1.0, 30.0}, std::pair{30.0, 1.0}, std::pair{0.0, 0.2}}) {
    const double least = direct_distance(v0, v1, limits);
    const Profile p = straight_profile(least, v0, v1, limits);
    EXPECT_EQ(p.turning_speed, std::max(v0, v1));
    EXPECT_DOUBLE_EQ(p.duration, 2 * least / (v0 + v1));
    EXPECT_LE(p.count, 7u);
    EXPECT_EQ(p.sample(p.duration).s, least);
    EXPECT_EQ(p.sample(p.duration).v, v1);
  }
}

/// From 1 to 100 mm/s with jerk alone limited the direct change takes 50.5·2√99 = 1005 mm, braking to rest first only
/// 1 + 1000.
TEST(Profile, DipsWhereTheDirectChangeIsTooLong) {
  const Limits limits{200, unlimited, 1};
  EXPECT_DOUBLE_EQ(direct_distance(1, 100, limits), 101 * std::sqrt(99.0));
  EXPECT_DOUBLE_EQ(min_distance(1, 100, limits), 1001);
  EXPECT_DOUBLE_EQ(min_distance(100, 1, limits), 1001);
  const Profile p = straight_profile(1003, 1, 100, limits), back = straight_profile(1003, 100, 1, limits);
  EXPECT_GT(p.turning_speed, 0);
  EXPECT_LT(p.turning_speed, 1);
  EXPECT_DOUBLE_EQ(back.duration, p.duration);
  const Profile rest = straight_profile(1001, 1, 100, limits);
  EXPECT_NEAR(rest.turning_speed, 0, 1e-12);
  EXPECT_NEAR(rest.duration, 2 + 20, 1e-6);
}

TEST(Profile, NothingToDo) {
  const Profile p = straight_profile(0, 0, 0, {1, 1, 1, 1});
  EXPECT_EQ(p.count, 0u);
  EXPECT_EQ(p.duration, 0);
  EXPECT_EQ(p.sample(0).s, 0);
  const Profile q = straight_profile(0, 2, 2, {3, 1, 1, 1});
  EXPECT_EQ(q.duration, 0);
  EXPECT_EQ(q.sample(1).v, 2);
  // Already as fast as allowed.
  const Profile r = straight_profile(6, 3, 3, {3, 1, 1, 1});
  EXPECT_EQ(r.count, 1u);
  EXPECT_EQ(r.duration, 2);
}

TEST(Profile, TooShortSaysHowMuchIsNeeded) {
  try {
    straight_profile(5, 3, 13, {20, 8});
    FAIL() << "feasible";
  } catch (const Infeasible& e) {
    EXPECT_THAT(e.what(), HasSubstr("10"));  // (169 − 9)/16
    EXPECT_THAT(e.what(), HasSubstr("13"));
  }
  EXPECT_THROW(straight_profile(0, 0, 1, {2, 1}), Infeasible);
  EXPECT_THROW(straight_profile(1000.9, 1, 100, {200, unlimited, 1}), Infeasible);
  EXPECT_NO_THROW(straight_profile(10 * (1 - 1e-13), 3, 13, {20, 8}));
}

std::vector<std::string> place_of_fault(double length, double v0, double v1, const Limits& limits) {
  try {
    straight_profile(length, v0, v1, limits);
  } catch (const InvalidInput& e) {
    return e.faults.size() == 1 ? e.faults[0].place : std::vector<std::string>{"several"};
  }
  return {"none"};
}

TEST(Profile, RefusesWhatIsNoMove) {
  const double nan = std::nan("");
  EXPECT_THAT(place_of_fault(-1, 0, 0, {1, 1}), ElementsAre("distance"));
  EXPECT_THAT(place_of_fault(nan, 0, 0, {1, 1}), ElementsAre("distance"));
  EXPECT_THAT(place_of_fault(unlimited, 0, 0, {1, 1}), ElementsAre("distance"));
  EXPECT_THAT(place_of_fault(1, -0.1, 0, {1, 1}), ElementsAre("start_speed"));
  EXPECT_THAT(place_of_fault(1, 2, 0, {1, 1}), ElementsAre("start_speed"));
  EXPECT_THAT(place_of_fault(1, 0, nan, {1, 1}), ElementsAre("end_speed"));
  EXPECT_THAT(place_of_fault(1, 0, 2, {1, 1}), ElementsAre("end_speed"));
  EXPECT_THAT(place_of_fault(1, 0, 0, {0, 1}), ElementsAre("limits", "velocity"));
  EXPECT_THAT(place_of_fault(1, 0, 0, {1, nan}), ElementsAre("limits", "acceleration"));
  EXPECT_THAT(place_of_fault(1, 0, 0, {1, 1, -1}), ElementsAre("limits", "jerk"));
  EXPECT_THAT(place_of_fault(1, 0, 0, {1, 1, 1, 0}), ElementsAre("limits", "snap"));
  EXPECT_THAT(place_of_fault(1, 0, 0, {1}), ElementsAre("limits"));
  EXPECT_THAT(place_of_fault(-1, 0, 0, {0, 1}), ElementsAre("several"));
  EXPECT_THROW(direct_distance(2, 0, {1, 1}), InvalidInput);
  EXPECT_THROW(min_distance(0, nan, {1, 1}), InvalidInput);
}

/// At the edge of what doubles hold: a result or a typed error, never a hang or nonsense.
TEST(Profile, SurvivesTheEdgeOfNumbers) {
  const double edge[] = {5e-324, 1e-300, 1e-150, 1, 1e150, 1e300, 1.7e308, unlimited};
  for (const double L : edge)
    for (const double V : edge)
      for (const double A : edge)
        for (const double J : edge)
          for (const double S : edge)
            for (const double share : {0.0, 0.5}) try {
                const double v = V < unlimited ? share * V : share;
                const Profile p = straight_profile(L, 0, v, {V, A, J, S});
                ASSERT_TRUE(p.duration >= 0 && p.duration < unlimited);
                ASSERT_LE(p.count, 15u);
                ASSERT_EQ(p.sample(p.duration).s, L);
              } catch (const PlanningError&) {
              }
}

/// A trapezoid is what the planner for any contour finds on a line.
TEST(Profile, EqualsThePlannerOnALine) {
  const Machine m = bahnwerk::testing::two_axes();
  const Vec direction{0.8, 0.6, 0};
  double V = unlimited, A = unlimited;
  for (std::size_t k = 0; k < 2; ++k) {
    V = std::min(V, m.axes[k].velocity / (k == 0 ? direction.x : direction.y));
    A = std::min(A, m.axes[k].acceleration / (k == 0 ? direction.x : direction.y));
  }
  for (const double feed : {unlimited, 0.3 * V})
    for (const double length : {1e-3, 1.0, 37.0, 5000.0}) {
      ContourBuilder b(2, {});
      b.block(Mode::cut, feed);
      b.line(length * direction);
      Progress progress;
      const double planned = plan_acceleration_limited(b.finish(), m, {}, progress).law.duration();
      EXPECT_NEAR(duration(length, {std::min(V, feed), A}), planned, 1e-9 * planned);
    }
}

TEST(Profile, BecomesALaw) {
  TimeLaw law;
  law.append({0, 1, 0, 2, 2, 0, 0, 0});
  const Profile p = straight_profile(30, 2, 1, {10, 5, 20});
  append(law, p, 2, 4);
  ASSERT_EQ(law.pieces().size(), 1 + p.count);
  EXPECT_DOUBLE_EQ(law.duration(), 1 + p.duration);
  EXPECT_EQ(law.pieces().back().s_end, 32);
  for (double t = 0; t < p.duration; t += 0.01) {
    const LawPiece& piece = law.pieces()[law.find(1 + t)];
    EXPECT_EQ(piece.segment, 4u);
    const LawState a = piece.at(1 + t - piece.t0);
    const ProfileState b = p.sample(t);
    EXPECT_NEAR(a.s, 2 + b.s, 1e-13);
    EXPECT_NEAR(a.v, b.v, 1e-13);
    EXPECT_NEAR(a.a, b.a, 1e-12);
  }
  const Profile snap = straight_profile(30, 2, 1, {10, 5, 20, 100});
  TimeLaw quartic;
  append(quartic, snap, 0, 0);
  ASSERT_EQ(quartic.pieces().size(), snap.count);
  EXPECT_DOUBLE_EQ(quartic.duration(), snap.duration);
  for (double t = 0; t < snap.duration; t += 0.01) {
    const LawPiece& piece = quartic.pieces()[quartic.find(t)];
    const LawState state = piece.at(t - piece.t0);
    EXPECT_NEAR(state.s, snap.sample(t).s, 1e-12);
    EXPECT_NEAR(state.j, snap.sample(t).j, 1e-9);
  }
}

}  // namespace
}  // namespace bahnwerk
