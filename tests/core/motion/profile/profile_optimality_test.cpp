/// That no motion is quicker: by duality for each move, and by exhaustive search on a lattice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/motion/profile/profile.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

/// Durations of the phases: up (jerk, hold, jerk), hold at the turning speed, down (jerk, hold, jerk).
struct Phases {
  double up = 0, up_hold = 0, hold = 0, down = 0, down_hold = 0;
};

/// An upper bound on ∫ v over T = 2 up + up_hold + hold + 2 down + down_hold of every motion with v(0) = v0, v(T) = v1,
/// v ≤ V, |a| ≤ A, |j| ≤ J, a = 0 at the ends. For any q, p with q' = μ − 1, p' = q + ν, μ ≥ 0 two integrations by
/// parts give ∫ v = ∫ μv − [qv] − ∫ νa − ∫ pj ≤ V ∫μ + A ∫|ν| + J ∫|p| + v0 q(0) − v1 q(T). Taken here: p = parabola
/// between the holds of the acceleration, 0 on them, negative outside; q jumps (point masses of μ) at the ends of a
/// hold of the speed and vanishes on it.
double bound(const Phases& f, double v0, double v1, double V, double A, double J) {
  auto times = [](double limit, double x) { return x > 0 ? limit * x : 0; };  // ∞ · 0 = 0
  double value = 0, integral_p = 0, up_slope = 0, down_slope = 0;
  if (f.hold > 0) {
    up_slope = f.up / 2;
    down_slope = f.down / 2;
    value += V * (f.hold + up_slope + down_slope);
    integral_p += (f.up * f.up * f.up + f.down * f.down * f.down) / 12;
  } else {
    const double width = f.up + f.down;
    up_slope = down_slope = width / 2;
    integral_p += width * width * width / 12;
  }
  auto side = [&](double slope, double jerk, double hold) {
    value += times(A, hold * (slope + hold / 2));
    integral_p += (slope + hold) * jerk * jerk / 2 + jerk * jerk * jerk / 6;
    return slope + hold + jerk;
  };
  value += v0 * side(up_slope, f.up, f.up_hold);
  value += v1 * side(down_slope, f.down, f.down_hold);
  return value + times(J, integral_p);
}

/// Reads the phases off the pieces of a trapezoid or double-S; `sign` −1 for a dip.
Phases phases(const Profile& p, double sign) {
  Phases f;
  for (const ProfilePiece& q : p.pieces()) {
    const double a = sign * q.at(q.duration / 2).a;
    if (a == 0) {
      f.hold += q.duration;
    } else if (q.j == 0) {
      (a > 0 ? f.up_hold : f.down_hold) += q.duration;
    } else {
      (a > 0 ? f.up : f.down) += q.duration / 2;
    }
  }
  return f;
}

double magnitude(Random& random, double low, double high) {
  return std::exp(random.uniform(std::log(low), std::log(high)));
}

TEST(ProfileOptimality, NoMotionCoversMoreDistanceInEqualTime) {
  Random random(51);
  for (int run = 0; run < 20000; ++run) {
    Limits l{magnitude(random, 1e-3, 1e3), magnitude(random, 1e-3, 1e3), magnitude(random, 1e-3, 1e3)};
    if (random.chance(0.2)) l.jerk = unlimited;
    if (random.chance(0.2) && l.jerk < unlimited) l.acceleration = unlimited;
    const double v0 = random.chance(0.3) ? 0 : l.velocity * random.uniform();
    const double v1 = random.chance(0.3) ? v0 : l.velocity * random.uniform();
    const double length = direct_distance(v0, v1, l) + l.velocity * magnitude(random, 1e-3, 1e3);
    const Profile p = straight_profile(length, v0, v1, l);
    const Phases f = phases(p, 1);
    ASSERT_NEAR(2 * f.up + f.up_hold + f.hold + 2 * f.down + f.down_hold, p.duration, 1e-14 * p.duration);
    ASSERT_NEAR(bound(f, v0, v1, l.velocity, l.acceleration, l.jerk), length, 1e-12 * length) << "run " << run;
  }
}

/// A dip, mirrored at v = 0: no motion goes less far in its time. And no quicker dip would do.
TEST(ProfileOptimality, NoMotionCoversLessDistanceInEqualTime) {
  Random random(52);
  int dips = 0;
  for (int run = 0; run < 20000; ++run) {
    Limits l{unlimited, magnitude(random, 1e-3, 1e3), magnitude(random, 1e-3, 1e3)};
    if (random.chance(0.3)) l.acceleration = unlimited;
    double v0 = magnitude(random, 1e-3, 1e3), v1 = v0 * magnitude(random, 1, 1e6);
    if (random.chance(0.5)) std::swap(v0, v1);
    const double direct = direct_distance(v0, v1, l), least = min_distance(v0, v1, l);
    if (direct <= least * (1 + 1e-9)) continue;
    const double length = least + (direct - least) * random.uniform();
    const Profile p = straight_profile(length, v0, v1, l);
    const Phases f = phases(p, -1);
    ASSERT_NEAR(-bound(f, -v0, -v1, 0, l.acceleration, l.jerk), length, 1e-12 * length) << "run " << run;
    const double low = std::min(v0, v1);
    for (int i = 0; i < 20; ++i) {  // a higher turn takes too long a way
      const double w = p.turning_speed + (low - p.turning_speed) * (i + 1) / 21;
      ASSERT_GT(direct_distance(v0, w, l) + direct_distance(w, v1, l), length);
    }
    ++dips;
  }
  EXPECT_GT(dips, 1000);
}

/// All motions whose jerk is −1, 0 or 1 over whole seconds, by dynamic programming over the lattice of (v, a): whatever
/// distance one of them reaches in N seconds, the straight move must cover in N seconds or less.
TEST(ProfileOptimality, BeatsEveryMotionOnALattice) {
  Random random(53);
  for (int run = 0; run < 60; ++run) {
    const int A = 1 + static_cast<int>(random.below(4)), V = 2 + static_cast<int>(random.below(19)), steps = 24;
    const int v0 = static_cast<int>(random.below(static_cast<std::uint64_t>(V) + 1));
    const int v1 = random.chance(0.3) ? v0 : static_cast<int>(random.below(static_cast<std::uint64_t>(V) + 1));
    const Limits l{static_cast<double>(V), static_cast<double>(A), 1};
    const auto speeds = static_cast<std::size_t>(2 * V + 1), width = static_cast<std::size_t>(2 * A + 1);
    struct Reach {
      int least, most;  // distance in sixths
    };
    const Reach nowhere{1 << 29, -(1 << 29)};
    auto index = [&](int v2, int a) { return static_cast<std::size_t>(v2) * width + static_cast<std::size_t>(a + A); };
    std::vector<Reach> now(speeds * width, nowhere), next;
    now[index(2 * v0, 0)] = {0, 0};
    const double direct = direct_distance(v0, v1, l);
    double closest = unlimited;  // how near the best lattice motion comes to the straight move's duration
    for (int n = 1; n <= steps; ++n) {
      next.assign(speeds * width, nowhere);
      for (int v2 = 0; v2 <= 2 * V; ++v2)
        for (int a = -A; a <= A; ++a) {
          const Reach from = now[index(v2, a)];
          if (from.least > from.most) continue;
          for (int j = -1; j <= 1; ++j) {
            // v may leave [0, V] only inside the second, where a changes sign; a is whole, so it cannot.
            const int w2 = v2 + 2 * a + j, b = a + j;
            if (w2 < 0 || w2 > 2 * V || b < -A || b > A) continue;
            const int step = 3 * v2 + 3 * a + j;
            Reach& to = next[index(w2, b)];
            to.least = std::min(to.least, from.least + step);
            to.most = std::max(to.most, from.most + step);
          }
        }
      now.swap(next);
      const Reach end = now[index(2 * v1, 0)];
      if (end.least > end.most) continue;
      for (const int sixths : {end.least, end.most}) {
        const double length = sixths / 6.0;
        ASSERT_GE(length, min_distance(v0, v1, l) * (1 - 1e-12)) << run;
        const double T = straight_profile(length, v0, v1, l).duration;
        ASSERT_LE(T, n * (1 + 1e-12)) << "run " << run << ": " << length << " mm from " << v0 << " to " << v1;
        if (length >= direct) closest = std::min(closest, n - T);
      }
    }
    EXPECT_LE(closest, 0.5) << run;
  }
}

/// A dip is the shallowest that fits, also where a snap limit puts kinks into the distance.
TEST(ProfileOptimality, ShallowestDip) {
  Random random(54);
  int dips = 0;
  for (int run = 0; run < 40000; ++run) {
    const Limits l{unlimited, magnitude(random, 1e-2, 1e2),
                   random.chance(0.3) ? unlimited : magnitude(random, 1e-2, 1e2), magnitude(random, 1e-2, 1e2)};
    double v0 = magnitude(random, 1e-2, 1e2), v1 = v0 * magnitude(random, 1, 1e3);
    if (random.chance(0.5)) std::swap(v0, v1);
    const double direct = direct_distance(v0, v1, l), least = min_distance(v0, v1, l);
    if (direct <= least * (1 + 1e-9)) continue;
    const double length = least + (direct - least) * random.uniform(), low = std::min(v0, v1);
    const double w = straight_profile(length, v0, v1, l).turning_speed;
    for (int i = 1; i < 40; ++i) {
      const double higher = w + (low - w) * i / 40;
      ASSERT_GT(direct_distance(v0, higher, l) + direct_distance(higher, v1, l), length * (1 - 1e-12)) << "run " << run;
    }
    ++dips;
  }
  EXPECT_GT(dips, 1000);
}

/// Snap alone limited, from rest to rest: the price of a vanishing jerk at the turn, as the header states it.
TEST(ProfileOptimality, PriceOfTheSnapLimitedForm) {
  const double T = straight_profile(1, 0, 0, {unlimited, unlimited, unlimited, 1}).duration;
  EXPECT_DOUBLE_EQ(T, std::pow(512, 0.25));
  EXPECT_NEAR(T / std::pow(384, 0.25), 1.0746, 1e-4);
}

}  // namespace
}  // namespace bahnwerk
