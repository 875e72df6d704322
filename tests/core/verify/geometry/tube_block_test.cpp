#include "core/verify/geometry/tube_block.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/polyline.hpp"
#include "core/verify/geometry/tube.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk {
namespace {

Check check(const Contour& given, const Contour& path, double tolerance) {
  Progress progress;
  return tube_checks(given, path, tolerance, progress).back();
}
Contour line(const std::vector<Vec>& points) { return polyline(2, points, false, 1); }

TEST(TubeBlock, OnlyTheGivenSegmentsAreMatched) {
  const Contour given = line({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}), path = line({{0, 0, 0}, {10, 0.03, 0}, {20, 0, 0}});
  verify::TubeBlock block(0.1, silent_scope());
  const verify::Worst whole = block.measure({&given.path, 0, 2}, {&path.path, 0, 2});
  EXPECT_GE(whole.value, 0.03);
  EXPECT_LE(whole.value, 0.0301);
  EXPECT_NEAR(whole.at, 10, 0.1);
  const Contour bent = line({{0, 0, 0}, {5, 3, 0}, {10, 0, 0}, {20, 0, 0}});
  EXPECT_LE(block.measure({&given.path, 1, 2}, {&bent.path, 2, 3}).value, 1e-12);
  EXPECT_GE(block.measure({&given.path, 0, 1}, {&bent.path, 0, 2}).value, 3 * (1 - 1e-9));
}

TEST(Tube, CoilsWithinTheTolerancePass) {
  // Some hundred turns that come back on themselves; the path leaves out every other vertex.
  std::vector<Vec> coil, half;
  for (int i = 0; i <= 600; ++i) {
    const Vec p{1e-4 * i + 0.003 * std::cos(2.0 * i), 0.003 * std::sin(2.0 * i), 0};
    coil.push_back(p);
    if (i % 2 == 0) half.push_back(p);
  }
  EXPECT_TRUE(check(line(coil), line(half), 0.01).passed);
  EXPECT_TRUE(check(line(half), line(coil), 0.01).passed);
  EXPECT_FALSE(check(line(coil), line(half), 0.001).passed);
}

TEST(Tube, MisleadingPlacesAreDecidedLocallyAndOthersAreStillChecked) {
  // Coils far apart along a zigzag of a thousand lines, which the path follows 0.004 mm aside.
  std::vector<Vec> given, path;
  std::size_t before_last = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec p{static_cast<double>(i), i % 2 == 0 ? 0.3 : -0.3, 0};
    given.push_back(p);
    path.push_back(p + Vec{0, 0.004, 0});
    if (i % 300 != 150) continue;
    before_last = path.size();
    for (int k = 0; k <= 600; ++k) {
      const Vec q = p + Vec{1e-4 * k + 0.003 * std::cos(2.0 * k), 0.003 * std::sin(2.0 * k), 0};
      given.push_back(q);
      if (k % 2 == 0) path.push_back(q);
    }
  }
  const Contour contour = line(given);
  const Check decided = check(contour, line(path), 0.01);
  EXPECT_TRUE(decided.passed);
  EXPECT_GE(decided.value, 0.004);
  for (const std::size_t place : {std::size_t{20}, before_last - 3, before_last - 20, path.size() - 2}) {
    std::vector<Vec> off = path;
    off[place].y += 0.02;
    const Check k = check(contour, line(off), 0.01);
    EXPECT_FALSE(k.passed) << place;
    EXPECT_GE(k.value, 0.0101) << place;
  }
}

}  // namespace
}  // namespace bahnwerk
