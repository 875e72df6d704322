#include "core/contour/blend/layout.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/polyline.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk::blending {
namespace {

const Ability fast{1800, 16000, HUGE_VAL, 1.8};

std::vector<Change> changes(const Contour& c, double tolerance, double tiny = 1e-6) {
  const auto list =
      element_runs(c.path, 0, c.path.size(), std::vector<std::size_t>(c.path.size(), 0), {tiny, 3.0}, silent_scope());
  EXPECT_EQ(list.size(), 1u);
  return lay_out(list[0], tolerance, std::vector<Ability>(list[0].elements.size(), fast), silent_scope());
}

TEST(BlendLayout, LongLinesGetCornersShortOnesARun) {
  std::vector<Vec> points{{}, {50, 0, 0}, {50, 50, 0}};
  for (int i = 1; i <= 50; ++i) points.push_back({50 - 0.2 * i, 50 + 0.002 * i * i, 0});
  const auto list = changes(polyline(2, points, false, 1), 0.02);
  ASSERT_EQ(list.size(), 3u);
  EXPECT_FALSE(list[0].run);
  EXPECT_FALSE(list[1].run);
  EXPECT_TRUE(list[2].run);
  EXPECT_LE(list[1].b, list[2].a);
}

TEST(BlendLayout, ChangesNeverOverlap) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    std::vector<Vec> points{{}};
    double heading = 0;
    for (int i = 0; i < 60; ++i) {
      heading += random.uniform(-1.5, 1.5);
      points.push_back(points.back() + std::pow(10, random.uniform(-3, 1)) * Vec{std::cos(heading), std::sin(heading)});
    }
    const Contour c = polyline(2, points, false, 1);
    double at = 0;
    for (const Change& change : changes(c, 0.02)) {
      EXPECT_GE(change.a, at) << seed;
      EXPECT_GT(change.b, change.a) << seed;
      at = change.b;
    }
    EXPECT_LE(at, c.path.length() * (1 + 1e-12));
  }
}

TEST(BlendLayout, StraightContinuationsAreLeftAlone) {
  EXPECT_TRUE(changes(polyline(2, {{}, {10, 0, 0}, {20, 0, 0}}, false, 1), 0.02).empty());
}

}  // namespace
}  // namespace bahnwerk::blending
