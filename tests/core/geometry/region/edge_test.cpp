#include "core/geometry/region/edge.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

using std::numbers::pi;

Edge random_edge(Random& random) {
  const auto point = [&] { return Point{random.uniform(-2, 2), random.uniform(-2, 2)}; };
  if (random.chance(0.4)) return line(point(), point());
  return arc(point(), random.uniform(0.2, 2), random.uniform(-pi, pi), random.uniform(-6, 6));
}

TEST(Edge, NearestPointEqualsABruteForceOne) {
  Random random(1);
  for (int k = 0; k < 3000; ++k) {
    const Edge edge = random_edge(random);
    const Point p{random.uniform(-4, 4), random.uniform(-4, 4)};
    double best = 1e300;
    for (int i = 0; i <= 2000; ++i) best = std::min(best, distance(edge.at(i / 2000.0), p));
    EXPECT_NEAR(distance(edge.at(edge.nearest(p)), p), best, 1e-4);
    EXPECT_LE(distance(edge.at(edge.nearest(p)), p), best + 1e-12);
  }
}

TEST(Edge, MeetingsLieOnBothAndNoneIsMissed) {
  Random random(2);
  for (int k = 0; k < 3000; ++k) {
    const Edge a = random_edge(random), b = random_edge(random);
    const auto found = meetings(a, b);
    for (const Meeting& m : found) EXPECT_NEAR(distance(a.at(m.first), b.at(m.second)), 0, 1e-9);
    // Where b changes sides of a's line or circle within a, there is a meeting.
    const auto side = [&](Point p) {
      return a.straight() ? cross(a.to - a.from, p - a.from) : distance(p, a.centre) - a.radius;
    };
    std::size_t crossings = 0;
    for (int i = 0; i < 2000; ++i) {
      const Point p = b.at(i / 2000.0), q = b.at((i + 1) / 2000.0);
      if ((side(p) > 0) == (side(q) > 0)) continue;
      const double f = a.nearest(0.5 * (p + q));
      if (f > 0.01 && f < 0.99) ++crossings;
    }
    EXPECT_GE(found.size(), crossings);
  }
}

TEST(Edge, PartsAndReversalsAreTheSameCurve) {
  Random random(3);
  for (int k = 0; k < 300; ++k) {
    const Edge edge = random_edge(random), part = edge.part(0.2, 0.7), back = edge.reversed();
    for (const double f : {0.0, 0.25, 1.0}) {
      EXPECT_NEAR(distance(part.at(f), edge.at(0.2 + 0.5 * f)), 0, 1e-12);
      EXPECT_NEAR(distance(back.at(f), edge.at(1 - f)), 0, 1e-12);
      EXPECT_NEAR(norm(back.direction(f) + edge.direction(1 - f)), 0, 1e-12);
    }
    EXPECT_NEAR(part.length(), edge.length() / 2, 1e-12);
    EXPECT_NEAR(back.doubled_area(), -edge.doubled_area(), 1e-12);
  }
}

}  // namespace
}  // namespace bahnwerk
