#include "core/geometry/curve/chord_fan.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace bahnwerk {
namespace {

double distance(Vec p, Vec a, Vec b) {
  const Vec way = b - a;
  const double length = dot(way, way);
  const double t = length > 0 ? std::clamp(dot(p - a, way) / length, 0.0, 1.0) : 0;
  return norm(p - (a + t * way));
}

/// Walks that turn, rest, go back and forth, and jump.
std::vector<Vec> random_walk(std::mt19937& random, std::size_t count, bool planar) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec> points{{}};
  Vec step{0.1, 0, 0};
  while (points.size() < count) {
    const double kind = uniform(random);
    if (kind > 0.9) step = std::pow(10.0, 2 * uniform(random)) * Vec{uniform(random), uniform(random), uniform(random)};
    if (kind < -0.95) step = -step;
    step += 0.05 * norm(step) * Vec{uniform(random), uniform(random), uniform(random)};
    if (planar) step.z = 0;
    points.push_back(points.back() + (kind > 0.85 && kind < 0.9 ? Vec{} : step));
  }
  return points;
}

TEST(ChordFan, EveryPointLeftOutLiesWithinTheToleranceOfItsChord) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 400; ++trial) {
    const bool planar = trial % 2 == 0;
    const double tolerance = std::pow(10.0, -3 + trial % 5);
    const std::vector<Vec> points = random_walk(random, 500, planar);
    ChordFan fan(tolerance, planar);
    fan.begin(points[0]);
    std::vector<std::size_t> kept{0};
    for (std::size_t i = 1; i < points.size(); ++i)
      if (!fan.take(points[i])) {
        ASSERT_GT(i - 1, kept.back());
        kept.push_back(i - 1);
        fan.begin(points[i - 1]);
        ASSERT_TRUE(fan.take(points[i]));
      }
    kept.push_back(points.size() - 1);
    for (std::size_t k = 1; k < kept.size(); ++k)
      for (std::size_t i = kept[k - 1]; i <= kept[k]; ++i)
        ASSERT_LE(distance(points[i], points[kept[k - 1]], points[kept[k]]), tolerance) << trial << " " << i;
  }
}

TEST(ChordFan, AStraightLineIsOneChordAndACircleHasFewOfThem) {
  ChordFan line(1e-3, true);
  line.begin({});
  for (int i = 1; i < 10000; ++i) ASSERT_TRUE(line.take({0.01 * i, 0.02 * i, 0}));
  ChordFan circle(1e-2, true);
  Vec last{10, 0, 0};
  circle.begin(last);
  int chords = 1;
  for (int i = 1; i <= 10000; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 10000;
    const Vec p{10 * std::cos(angle), 10 * std::sin(angle), 0};
    if (!circle.take(p)) ++chords, circle.begin(last), circle.take(p);
    last = p;
  }
  EXPECT_LE(chords, 110);  // chords with a sagitta of 0.01 mm: 70
}

}  // namespace
}  // namespace bahnwerk
