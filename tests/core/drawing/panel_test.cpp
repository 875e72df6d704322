#include "core/drawing/panel.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "core/drawing/ticks.hpp"

namespace bahnwerk::drawing {
namespace {

using testing::HasSubstr;

TEST(Ticks, AreRoundNumbers) {
  EXPECT_EQ(nice(0.7), 1);
  EXPECT_EQ(nice(1.2), 2);
  EXPECT_EQ(nice(30), 50);
  EXPECT_DOUBLE_EQ(nice(0.0051), 0.01);
  std::vector<double> at;
  for_each_tick(-1, 2.1, 1, [&](double value) { at.push_back(value); });
  EXPECT_THAT(at, testing::ElementsAre(-1, 0, 1, 2));
  EXPECT_EQ(tick_label(-1e-13), "0");
}

/// y from 0 to 10 with 6 % on both sides: 100 px over 11.2.
TEST(Panel, PutsCurvesAndLimitsWhereTheyBelong) {
  Panel panel{"up, mm", "t, s", {{"q", "#123456", {{0, 0}, {2, 10}}, true}}, {5}};
  const std::string svg = panel_drawing(panel, 50, 20, 200, 100);
  EXPECT_THAT(svg, HasSubstr("M50 114.6L250 25.4"));
  EXPECT_THAT(svg, HasSubstr("class=\"limit\""));
  EXPECT_THAT(svg, HasSubstr("M50 70L250 70"));
  EXPECT_THAT(svg, HasSubstr("up, mm"));
  EXPECT_THAT(svg, HasSubstr("t, s"));
  EXPECT_THAT(svg, HasSubstr("<circle"));
}

TEST(Panel, SurvivesNothingAndConstants) {
  EXPECT_THAT(panel_drawing({"empty", "", {}, {}}, 0, 0, 10, 10), testing::Not(HasSubstr("nan")));
  const Panel level{"level", "", {{"q", "#000000", {{1, 5}, {1, 5}}}}, {}};
  const std::string svg = panel_drawing(level, 0, 0, 10, 10);
  EXPECT_THAT(svg, testing::Not(HasSubstr("nan")));
  EXPECT_THAT(svg, testing::Not(HasSubstr("inf")));
}

TEST(Envelope, KeepsTheLeastAndTheLargestOfEveryColumn) {
  Envelope envelope(4, 8);
  for (int i = 0; i <= 800; ++i) envelope.add(0.01 * i, std::sin(i));
  const std::vector<Point> points = envelope.points();
  ASSERT_EQ(points.size(), 8u);
  for (std::size_t i = 0; i < 8; i += 2) {
    EXPECT_EQ(points[i].x, 1 + 2 * static_cast<double>(i / 2));
    EXPECT_NEAR(std::max(points[i].y, points[i + 1].y), 1, 1e-3);
    EXPECT_NEAR(std::min(points[i].y, points[i + 1].y), -1, 1e-3);
  }
  EXPECT_TRUE(Envelope(4, 8).points().empty());
}

}  // namespace
}  // namespace bahnwerk::drawing
