#include "core/geometry/path/matched.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"

namespace bahnwerk {
namespace {

TEST(Matched, TheNearestPointOfAnArcIsWhereTheRadiusMeetsIt) {
  const Arc arc = Arc::through({5, 0, 0}, {0, 5, 0}, {0, 0, 0}, {0, 0, 1}, true);
  for (const double angle : {0.1, 0.7, 1.4})
    for (const double radius : {4.5, 5.0, 5.6}) {
      const Nearest found =
          nearest(arc, arc.begin(), arc.end(), {radius * std::cos(angle), radius * std::sin(angle), 0});
      EXPECT_NEAR(found.distance, std::abs(radius - 5), 1e-9);
      EXPECT_NEAR(norm(arc.at(found.u).value - Vec{5 * std::cos(angle), 5 * std::sin(angle), 0}), 0, 1e-6);
    }
}

TEST(Matched, PointsBehindAnEndAreNearestToIt) {
  const Line line({0, 0, 0}, {10, 0, 0});
  EXPECT_NEAR(nearest(line, line.begin(), line.end(), {-3, 4, 0}).distance, 5, 1e-12);
  EXPECT_NEAR(nearest(line, line.begin(), line.end(), {13, -4, 0}).distance, 5, 1e-12);
}

TEST(Matched, ParallelArcsAreAsFarApartAsTheirRadii) {
  const Arc inner = Arc::through({5, 0, 0}, {0, 5, 0}, {0, 0, 0}, {0, 0, 1}, true),
            outer = Arc::through({5.2, 0, 0}, {0, 5.2, 0}, {0, 0, 0}, {0, 0, 1}, true);
  const MatchedDistance distance(inner, outer);
  double found = 0;
  const double bound =
      distance.bound({inner.begin(), inner.end(), outer.begin(), outer.end(), 0.2, 0.2}, 1, 1e-6, found);
  EXPECT_GE(bound, 0.2 - 1e-12);
  EXPECT_LE(bound, 0.2 + 2e-6);
  EXPECT_NEAR(found, 0.2, 1e-6);
}

TEST(Matched, ADistanceAboveTheToleranceIsReported) {
  // A chord and its arc: the sagitta is 5 (1 − cos 45°).
  const Arc arc = Arc::through({5, 0, 0}, {0, 5, 0}, {0, 0, 0}, {0, 0, 1}, true);
  const Line chord({5, 0, 0}, {0, 5, 0});
  const MatchedDistance distance(arc, chord);
  const double sagitta = 5 * (1 - std::sqrt(0.5));
  double found = 0;
  EXPECT_GT(distance.bound({arc.begin(), arc.end(), chord.begin(), chord.end(), 0, 0}, 0.9 * sagitta, 1e-6, found),
            0.9 * sagitta);
  found = 0;
  EXPECT_NEAR(distance.bound({arc.begin(), arc.end(), chord.begin(), chord.end(), 0, 0}, 2 * sagitta, 1e-6, found),
              sagitta, 2e-6);
}

}  // namespace
}  // namespace bahnwerk
