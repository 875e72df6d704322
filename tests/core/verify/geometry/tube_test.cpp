#include "core/verify/geometry/tube.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/contour/polyline.hpp"
#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/rational.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

Check check(const Contour& given, const Contour& path, double tolerance) {
  Progress progress;
  return tube_checks(given, path, tolerance, progress).back();
}
Contour line(std::vector<Vec> points) { return polyline(2, points, false, 1); }

TEST(Tube, SameContourIsAtNoDistance) {
  ContourBuilder b(2, {});
  b.line({10, 0, 0});
  b.arc({10, 0, 0}, {10, 5, 0}, true);  // a full circle
  b.nurbs(3, {{10, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}}, {1, 3, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1});
  const Contour c = b.finish();
  const Check k = check(c, c, 0.01);
  EXPECT_TRUE(k.passed);
  EXPECT_LE(k.value, 1.5e-6);
  EXPECT_EQ(check_name(k), "deviation from contour");
}

TEST(Tube, ParallelLinesAndArcs) {
  EXPECT_NEAR(check(line({{}, {10, 0, 0}}), line({{0, 0.004, 0}, {10, 0.004, 0}}), 0.01).value, 0.004, 2e-6);
  const auto arc = [](double radius) {
    Contour c;
    c.blocks = {{Mode::cut, 1, 0, 1}};
    c.path.append(std::make_shared<Arc>(Arc({}, {1, 0, 0}, {0, 1, 0}, radius, 4)), 0);
    return c;
  };
  EXPECT_NEAR(check(arc(10), arc(10.003), 0.01).value, 0.003, 2e-6);
  EXPECT_FALSE(check(arc(10), arc(10.02), 0.01).passed);
}

TEST(Tube, ACutCornerCountsFromBothSides) {
  // The chamfer is 0.1·√½ from the corner, though its points are at most 0.05 from the lines.
  const Contour given = line({{}, {10, 0, 0}, {10, 10, 0}});
  const Contour chamfer = line({{}, {9.9, 0, 0}, {10, 0.1, 0}, {10, 10, 0}});
  EXPECT_NEAR(check(given, chamfer, 0.08).value, 0.1 * std::sqrt(0.5), 2e-6);
  EXPECT_TRUE(check(given, chamfer, 0.0708).passed);
  EXPECT_FALSE(check(given, chamfer, 0.0706).passed);
}

TEST(Tube, SeesABulgeBetweenSamples) {
  // A bump 0.011 high and 0.02 wide in the middle of a long line.
  Contour bump;
  bump.blocks = {{Mode::cut, 1, 0, 3}};
  const auto add = [&](const std::vector<Vec>& p) {
    bump.path.append(std::make_shared<Rational>(Rational::bezier(p)), 0);
  };
  add({{}, {50, 0, 0}});
  add({{50, 0, 0}, {50.01, 0.022, 0}, {50.02, 0, 0}});
  add({{50.02, 0, 0}, {100, 0, 0}});
  const Check k = check(line({{}, {100, 0, 0}}), bump, 0.01);
  EXPECT_FALSE(k.passed);
  EXPECT_GE(k.value, 0.011 - 1e-9);
  EXPECT_NEAR(k.at, 50, 0.1);
  EXPECT_NEAR(check(line({{}, {100, 0, 0}}), bump, 0.02).value, 0.011, 2e-6);
}

TEST(Tube, AMissingLoopIsMissed) {
  // The path leaves out a loop that begins and ends at the same point.
  const Contour given = line({{}, {10, 0, 0}, {15, 0, 0}, {15, 5, 0}, {10, 0, 0}, {10, -10, 0}});
  EXPECT_FALSE(check(given, line({{}, {10, 0, 0}, {10, -10, 0}}), 0.01).passed);
  EXPECT_TRUE(check(given, given, 0.01).passed);
}

TEST(Tube, ABranchNearbyDoesNotCount) {
  // Two passes of the same line; the path wanders to where the contour only comes later.
  const Contour given = line({{}, {10, 0, 0}, {10, 5, 0}, {0, 5, 0}, {0, 0.005, 0}, {20, 0.005, 0}});
  const Contour shortcut = line({{}, {20, 0, 0}});
  EXPECT_FALSE(check(given, shortcut, 0.01).passed);
}

TEST(Tube, BackAndForthOnOneLine) {
  const Contour given = line({{}, {10, 0, 0}, {5, 0, 0}, {20, 0, 0}, {0, 0, 0}});
  EXPECT_TRUE(check(given, given, 0.01).passed);
  EXPECT_FALSE(check(given, line({{}, {20, 0, 0}, {0, 0, 0}}), 0.01).passed);
}

TEST(Tube, EndsCount) {
  EXPECT_NEAR(check(line({{}, {10, 0, 0}}), line({{}, {9.995, 0, 0}}), 0.01).value, 0.005, 2e-6);
  EXPECT_FALSE(check(line({{}, {10, 0, 0}}), line({{}, {9.98, 0, 0}}), 0.01).passed);
}

/// Three blocks of one line each, with the borders at `one` and `two`.
Contour blocks(double one, double two) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 200);
  b.line({one, 0, 0});
  b.block(Mode::cut, 5);
  b.line({two, 0, 0});
  b.block(Mode::position, 200);
  b.line({10, 0, 0});
  return b.finish();
}
std::vector<Check> checks(const Contour& given, const Contour& path) {
  Progress progress;
  return tube_checks(given, path, 0.01, progress);
}

TEST(Tube, BordersStayWhereTheyWere) {
  const Contour given = blocks(4, 4.2);
  for (const Check& c : checks(given, blocks(4.0099, 4.1901))) EXPECT_TRUE(c.passed) << check_name(c);
  for (const auto& [one, two] : {std::pair{4.0101, 4.2}, {4.0, 4.1899}, {3.9, 4.1}}) {
    const auto moved = checks(given, blocks(one, two));
    EXPECT_TRUE(moved[0].passed);
    EXPECT_FALSE(moved[1].passed) << one;
  }
}

TEST(Tube, BlocksAreTheContours) {
  const Contour given = blocks(4, 4.2);
  const auto refused = [&](const Contour& path) {
    const auto list = checks(given, path);
    EXPECT_EQ(check_name(list[0]), "blocks out of order");
    EXPECT_FALSE(list[0].passed);
    EXPECT_GE(list[0].value, 1);
    EXPECT_FALSE(list[1].passed);
  };
  Contour path = given;
  path.blocks[1].mode = Mode::position;
  refused(path);
  path = given;  // the slow block's length is given to the one before
  path.blocks[0].last = path.blocks[1].first = 2;
  refused(path);
  path = given;
  path.blocks.pop_back();
  refused(path);
  path = given;
  path.blocks[2].last = 2;
  refused(path);
  path = given;  // overlapping
  path.blocks[1].first = 0;
  refused(path);
  path = given;
  std::swap(path.blocks[0], path.blocks[1]);
  refused(path);
}

}  // namespace
}  // namespace bahnwerk
