/// Against the reachable set: with jerk ±J switched by bisection, and against hand-made cases.
#include "core/verify/bound/rest_to_rest.hpp"

#include <gtest/gtest.h>

#include "core/numeric/random.hpp"

namespace bahnwerk::verify {
namespace {

/// Way of the symmetric move with peak speed w: twice the change 0 → w at mean speed w/2, found without closed forms.
double way_to(double w, double A, double J) {
  // Acceleration rises with J to a, holds, falls: w = a (t − a/J) with the least t.
  double low = 0, high = A;
  for (int i = 0; i < 200; ++i) {  // the largest a ≤ A that does not overshoot w
    const double a = 0.5 * (low + high);
    (a * a / J <= w ? low : high) = a;
  }
  const double t = w / low + low / J;
  return w * t;
}

double brute(double way, double V, double A, double J) {
  double low = 0, high = V;
  for (int i = 0; i < 200; ++i) {
    const double w = 0.5 * (low + high);
    (way_to(w, A, J) <= way ? low : high) = w;
  }
  const double used = way_to(low, A, J);
  return 2 * used / low + (way - used) / low;  // both changes last used/low each …
}

TEST(RestToRest, EqualsASearchForThePeakSpeed) {
  Random random(3);
  int kinds[3] = {0, 0, 0};
  for (int n = 0; n < 2000; ++n) {
    const double V = std::pow(10, random.uniform(0, 4)), A = std::pow(10, random.uniform(1, 5)),
                 J = std::pow(10, random.uniform(2, 7)), way = std::pow(10, random.uniform(-3, 3));
    const double T = rest_to_rest(way, V, A, J);
    EXPECT_NEAR(T, brute(way, V, A, J), 1e-9 * T) << V << ' ' << A << ' ' << J << ' ' << way;
    const double ramp = A / J, change = V >= A * ramp ? V / A + ramp : 2 * std::sqrt(V / J);
    ++kinds[way >= V * change ? 0 : way >= 2 * A * ramp * ramp ? 1 : 2];
  }
  for (const int kind : kinds) EXPECT_GT(kind, 100);
}

TEST(RestToRest, HasKnownDurationsWithoutLimits) {
  EXPECT_DOUBLE_EQ(rest_to_rest(100, unlimited, 16000, unlimited), 2 * std::sqrt(100.0 / 16000));
  EXPECT_DOUBLE_EQ(rest_to_rest(1000, 1800, 16000, unlimited), 1000.0 / 1800 + 1800.0 / 16000);
  EXPECT_EQ(rest_to_rest(0, 1, 1, 1), 0);
}

}  // namespace
}  // namespace bahnwerk::verify
