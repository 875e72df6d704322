/// The drawing of a contour shows all of it, as exactly as it says, and never grows beyond its budget.
#include "core/plan/contour/contour_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/plan/random_contour.hpp"

namespace bahnwerk {
namespace {

std::string draw(const Contour& contour, std::size_t most = 200'000) {
  Progress progress;
  return contour_drawing(contour, {"a title <&", most}, progress);
}

struct Stroke {
  double x0, y0, x1, y1;
  double distance(double x, double y) const {
    const double dx = x1 - x0, dy = y1 - y0, square = dx * dx + dy * dy;
    const double f = square > 0 ? std::clamp(((x - x0) * dx + (y - y0) * dy) / square, 0.0, 1.0) : 0;
    return std::hypot(x - x0 - f * dx, y - y0 - f * dy);
  }
};

/// Lines of all paths of a class, px.
std::vector<Stroke> strokes(const std::string& drawing, const std::string& name) {
  std::vector<Stroke> list;
  for (std::size_t at = 0; (at = drawing.find("<path class=\"" + name + "\"", at)) != std::string::npos; ++at) {
    const double unit = std::strtod(drawing.c_str() + drawing.find("scale(", at) + 6, nullptr);
    const char* data = drawing.c_str() + drawing.find(" d=\"", at) + 4;
    double x = 0, y = 0;
    for (char command = 0; *data != '"';) {
      if (*data == 'M' || *data == 'l') command = *data++;
      char* next = nullptr;
      const double first = std::strtod(data, &next), second = std::strtod(next, &next);
      data = next;
      const double to_x = command == 'M' ? first : x + first, to_y = command == 'M' ? second : y + second;
      if (command == 'l') list.push_back({x * unit, y * unit, to_x * unit, to_y * unit});
      x = to_x, y = to_y;
    }
  }
  return list;
}

/// What the legend says of it; negative if nothing.
double tolerance_mm(const std::string& drawing) {
  std::smatch found;
  return std::regex_search(drawing, found, std::regex("drawn to ([0-9.e+-]+) mm")) ? std::stod(found[1]) : -1;
}

bool has(const std::string& drawing, const std::string& text) { return drawing.find(text) != std::string::npos; }

TEST(ContourDrawing, TheLegendEndsInsideTheDrawing) {
  // As tall as it is narrow, with everything that a legend can name and lengths of many digits.
  ContourBuilder b(2, {});
  b.block(Mode::position, unlimited);
  b.line({10.25, 1210.75, 0});
  b.block(Mode::cut, unlimited);
  b.line({10.25, 26.0625, 0});
  const Contour contour = b.finish();
  TimeLaw law;
  double s = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double length = contour.path[i].length();
    law.append({.duration = 1, .s = s, .s_end = s + length, .v = length, .a = 0, .j = 0, .segment = i});
    s += length;
  }
  Progress progress;
  for (const TimeLaw* speeds : {static_cast<const TimeLaw*>(nullptr), static_cast<const TimeLaw*>(&law)}) {
    const std::vector<Vec> way{{0, 0, 0}, {10.25, 1210.75, 0}};
    const std::string drawing = contour_drawing(contour, {.title = "legend", .way = way, .law = speeds}, progress);
    std::smatch size;
    ASSERT_TRUE(std::regex_search(drawing, size, std::regex("<svg[^>]* width=\"([0-9.]+)\"")));
    const std::regex text("<text x=\"([0-9.]+)\" y=\"42\"[^>]*>([^<]*)</text>");
    std::size_t texts = 0;
    for (std::sregex_iterator it(drawing.begin(), drawing.end(), text), end; it != end; ++it, ++texts)
      EXPECT_LE(std::stod((*it)[1]) + 6.5 * static_cast<double>((*it)[2].length()), std::stod(size[1])) << (*it)[2];
    EXPECT_GE(texts, 5u) << "cut, position, coarse axes, begin, drawn to";
  }
}

TEST(ContourDrawing, CutsAreColouredByTheirSpeed) {
  // A line of 100 mm from rest to rest at 1000 mm/s²: v = √(2 a s) up to the middle, there 316 mm/s.
  ContourBuilder b(2, {});
  b.block(Mode::cut, unlimited);
  b.line({100, 0, 0});
  const Contour contour = b.finish();
  TimeLaw law;
  const double middle = std::sqrt(2 * 1000 * 50.0);
  law.append({.duration = middle / 1000, .s = 0, .s_end = 50, .v = 0, .a = 1000, .j = 0, .segment = 0});
  law.append({.duration = middle / 1000, .s = 50, .s_end = 100, .v = middle, .a = -1000, .j = 0, .segment = 0});
  Progress progress;
  const std::string drawing = contour_drawing(contour, {.title = "by speed", .law = &law}, progress);
  EXPECT_TRUE(has(drawing, "316.2 mm/s"));
  const auto all = strokes(drawing, "cut");
  double length = 0, low = HUGE_VAL, high = -HUGE_VAL;
  for (const Stroke& s : all) {
    length += std::abs(s.x1 - s.x0);
    low = std::min({low, s.x0, s.x1}), high = std::max({high, s.x0, s.x1});
  }
  EXPECT_NEAR(length, high - low, 2) << "every place is drawn once";
  // The share of the line in each colour: v below a tenth of the largest on 1 % of either half, and so on.
  std::size_t colours = 0;
  for (std::size_t at = 0; (at = drawing.find("<path class=\"cut\"", at)) != std::string::npos; ++at, ++colours) {
    const std::string one = drawing.substr(at, drawing.find("/>", at) + 2 - at);
    double share = 0;
    for (const Stroke& s : strokes(one, "cut")) share += std::abs(s.x1 - s.x0) / (high - low);
    const double k = static_cast<double>(colours) / 10;
    EXPECT_NEAR(share, (k + 0.1) * (k + 0.1) - k * k, 0.02) << colours;
  }
  EXPECT_EQ(colours, 10u);
  EXPECT_EQ(drawing, contour_drawing(contour, {.title = "by speed", .law = &law}, progress));
}

TEST(ContourDrawing, CutsPositionsAndLegend) {
  ContourBuilder b(2, {});
  b.block(Mode::position, unlimited);
  b.line({10, 0, 0});
  b.block(Mode::cut, 100);
  b.arc({10, 0, 0}, {10, 20, 0}, true);
  const std::string drawing = draw(b.finish());
  EXPECT_TRUE(has(drawing, "position 10 mm"));
  EXPECT_TRUE(has(drawing, "cut 125.664 mm"));
  EXPECT_TRUE(has(drawing, "a title &lt;&amp;"));
  EXPECT_TRUE(has(drawing, "x, mm"));
  EXPECT_FALSE(has(drawing, "z, mm"));
  const auto way = strokes(drawing, "position"), cut = strokes(drawing, "cut");
  ASSERT_EQ(way.size(), 1u);
  ASSERT_GT(cut.size(), 20u);
  // The way's ten millimetres give the scale; every chord of the circle has its 20 mm from the centre.
  const double scale = (way[0].x1 - way[0].x0) / 10, x = way[0].x1, y = way[0].y1 - 20 * scale;
  const double off = tolerance_mm(drawing);
  ASSERT_GT(off, 0);
  EXPECT_NEAR(off * scale, 0.2, 0.02);
  for (const Stroke& s : cut)
    for (const double f : {0.0, 0.25, 0.5, 0.75, 1.0})
      EXPECT_NEAR(std::hypot(s.x0 + f * (s.x1 - s.x0) - x, s.y0 + f * (s.y1 - s.y0) - y), 20 * scale, 0.2);
}

TEST(ContourDrawing, PathsInSpaceAreDrawnFromAboveAndFromTheFront) {
  ContourBuilder b(3, {});
  b.block(Mode::cut, 100);
  b.line({10, 20, 30});
  const std::string drawing = draw(b.finish());
  EXPECT_TRUE(has(drawing, "z, mm"));
  const auto lines = strokes(drawing, "cut");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NEAR((lines[1].y0 - lines[1].y1) / (lines[0].y0 - lines[0].y1), 1.5, 0.01);
}

TEST(ContourDrawing, EveryPointOfThePathIsNearALine) {
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(7000 + seed));
    auto outline = testing::random_outline(random, 1 + random.below(30), 2);
    // A tripod of lines in front tells where the drawing puts a point: 10 mm to the right, then 10 mm up.
    const Vec at = outline.shapes.front().from;
    const std::size_t most = seed % 2 ? 200'000 : 8000;
    ContourBuilder b(2, at - Vec{10, 10, 0});
    b.block(Mode::position, 1);
    b.line(at - Vec{0, 10, 0});
    b.line(at);
    b.block(Mode::cut, 1);
    const Contour rest = testing::build(outline);
    Contour contour = b.finish();
    contour.blocks.back().first = contour.path.size();
    for (std::size_t i = 0; i < rest.path.size(); ++i)
      contour.path.append(std::shared_ptr<const Curve>(&rest.path[i].curve(), [](const Curve*) {}), i);
    contour.blocks.back().last = contour.path.size();
    const std::string drawing = draw(contour, most);
    ASSERT_LE(drawing.size(), most);
    const double e = tolerance_mm(drawing);
    if (e < 0) continue;  // said that it is not drawn
    const auto way = strokes(drawing, "position"), cut = strokes(drawing, "cut");
    ASSERT_FALSE(cut.empty());
    if (way.size() != 2 || e > 0.2) continue;
    const double scale = (way[0].x1 - way[0].x0) / 10;
    for (std::size_t i = 2; i < contour.path.size(); ++i)
      for (int k = 0; k <= 40; ++k) {
        const Segment& s = contour.path[i];
        const Vec p = s.at(s.s0() + s.length() * k / 40).value - at;
        const double x = way[1].x1 + scale * p.x, y = way[1].y1 - scale * p.y;
        double nearest = HUGE_VAL;
        for (const Stroke& line : cut) nearest = std::min(nearest, line.distance(x, y));
        // The tripod's own ends are drawn no more exactly; ten millimetres of it give the scale.
        EXPECT_LE(nearest / scale, 2.2 * e + norm(p) * 0.2 * e) << i << ' ' << k;
      }
  }
}

TEST(ContourDrawing, LargeContoursKeepTheirBudget) {
  Random random(3);
  ContourBuilder b(2, {});
  for (int i = 0; i < 30'000; ++i) {
    b.block(i % 2 ? Mode::cut : Mode::position, unlimited);
    for (int k = 0; k < 3; ++k) b.line({random.uniform(0, 300), random.uniform(0, 200), 0});
  }
  const std::string drawing = draw(b.finish());
  EXPECT_LE(drawing.size(), 200'000u);
  EXPECT_TRUE(tolerance_mm(drawing) > 0 || has(drawing, "too intricate"));
  // A fine polyline needs no more than what shows.
  ContourBuilder fine(2, {});
  fine.block(Mode::cut, unlimited);
  for (int i = 1; i <= 200'000; ++i) fine.line({i * 1e-3, 20 * std::sin(i * 1e-4), 0});
  EXPECT_LE(draw(fine.finish()).size(), 20'000u);
}

TEST(ContourDrawing, OnePointAndOneAxis) {
  for (const Vec to : {Vec{1e-3, 0, 0}, Vec{0, 1e6, 0}, Vec{1e7, 1e7, 0}}) {
    ContourBuilder b(2, {});
    b.block(Mode::cut, unlimited);
    b.line(to);
    EXPECT_EQ(strokes(draw(b.finish()), "cut").size(), 1u);
  }
}

}  // namespace
}  // namespace bahnwerk
