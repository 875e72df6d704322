#include "core/contour/contour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "core/geometry/curve/line.hpp"

namespace bahnwerk {
namespace {

/// Four lines of 1 mm: straight on, a turn of 0.1 rad, a turn back; blocks that cut one, position two, cut one.
Contour four_lines() {
  Contour c;
  const double angles[] = {0, 0, 0.1, 0.1 + std::numbers::pi};
  Vec at{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec to = at + Vec{std::cos(angles[i]), std::sin(angles[i]), 0};
    c.path.append(std::make_shared<const Line>(at, to), i);
    at = to;
  }
  c.blocks = {{Mode::cut, 5, 0, 1}, {Mode::cut, 1, 1, 1}, {Mode::position, 50, 1, 3}, {Mode::cut, 5, 3, 4}};
  c.rests = {{2, 0.5, 2}, {4, 0.25, 3}};
  return c;
}

TEST(Contour, FeedsAndRestsArePerSegment) {
  const Contour c = four_lines();
  EXPECT_EQ(c.feeds(), (std::vector<double>{5, 50, 50, 5}));
  EXPECT_EQ(c.rest_places(), (std::vector<bool>{false, false, true, false, true}));
  EXPECT_EQ(c.dwell(), 0.75);
}

TEST(Contour, ModeChangesStopBetweenBlocksThatHaveSegments) {
  Contour c = four_lines();
  stop_at_mode_changes(c);
  std::vector<std::size_t> segments, blocks;
  for (const Rest& rest : c.rests) segments.push_back(rest.segment), blocks.push_back(rest.block);
  EXPECT_EQ(segments, (std::vector<std::size_t>{1, 2, 3, 4}));
  EXPECT_EQ(blocks, (std::vector<std::size_t>{2, 2, 3, 3}));
  EXPECT_EQ(c.dwell(), 0.75) << "they last no time";
}

TEST(Contour, JointsHaveTheAngleAndStepOfTheirTangents) {
  const Contour c = four_lines();
  const std::vector<Joint> found = joints(c.path);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].angle, 0);
  EXPECT_NEAR(found[1].angle, 0.1, 1e-14);
  EXPECT_NEAR(found[1].step.y, std::sin(0.1), 1e-14);
  EXPECT_DOUBLE_EQ(found[1].s, 2);
  EXPECT_NEAR(found[2].angle, std::numbers::pi, 1e-12);
  EXPECT_NEAR(norm(found[2].step), 2, 1e-12);
  EXPECT_FALSE(stops_at(c.path, 2, 0.11));
  EXPECT_TRUE(stops_at(c.path, 2, 0.09));
  EXPECT_TRUE(joints({}).empty());
}

}  // namespace
}  // namespace bahnwerk
