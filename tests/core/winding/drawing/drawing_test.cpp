#include "core/winding/drawing/drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/winding/slot/coil_sides.hpp"

namespace bahnwerk::winding {
namespace {

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

Slot box() { return make_slot(PolygonSlot{{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, 0, 0}); }

TEST(Drawing, HasEveryWireAndCrossesOutWhatSlips) {
  const std::string svg =
      slot_drawing(box(), {"a < b & c", 1, 1.8, {{1, 1}, {3, 1}, {5, 1}, {2, 1 + std::sqrt(3.0)}}, {2}});
  EXPECT_EQ(times(svg, "<circle"), 2u * 4 + 1);
  EXPECT_EQ(times(svg, "#c1121f"), 4u) << "a ring, two strokes, and the legend";
  EXPECT_NE(svg.find("a &lt; b &amp; c"), svg.npos);
  EXPECT_EQ(times(svg, "<path"), 2u + 2) << "iron, usable area, and the cross";
  EXPECT_EQ(svg.find("nan"), svg.npos);
}

TEST(Drawing, IsTheSlotWithoutWires) {
  EXPECT_EQ(times(slot_drawing(make_slot(RotorSlot{}), {"empty", 1, 0.9, {}, {}}), "<circle"), 0u);
}

TEST(Drawing, LayersCountFromTheBase) {
  const std::vector<Point> wires{
      {1, 1},      {3, 1}, {5, 1}, {2, 1 + std::sqrt(3.0)}, {4, 1 + std::sqrt(3.0)}, {3, 1 + 2 * std::sqrt(3.0)},
      {0.95, 4.95}};
  EXPECT_EQ(layers(box().usable_area, 1, wires), (std::vector{0, 0, 0, 1, 1, 2, -1}));
}

TEST(Drawing, ChartHasACurveForEachFactor) {
  const std::vector<FillCurve> curves{{Algorithm::needle, {{0.5, 0.53, 0.78}, {0.9, 0.54, 0.74}}},
                                      {Algorithm::raabe, {{0.5, 0.52, 0.77}, {0.9, 0.53, 0.73}}}};
  const std::string svg = fill_chart(curves, "all");
  EXPECT_EQ(times(svg, "stroke-dasharray"), 2u);
  EXPECT_EQ(times(svg, "<circle"), 8u);
  EXPECT_NO_THROW(fill_chart({}, "nothing"));
}

/// The x of all points of the first curve, in its order.
std::vector<double> across(const std::string& svg) {
  std::vector<double> list;
  const std::size_t end = svg.find("\" fill=\"none\" stroke-width=\"2\""), begin = svg.rfind("<path d=\"", end) + 9;
  for (std::size_t at = begin; at < end; at = svg.find_first_of("ML", at + 1))
    list.push_back(std::stod(svg.substr(at + 1)));
  return list;
}

TEST(Drawing, ChartGoesByDiameterWhateverTheOrderOfTheWires) {
  const FillCurve mixed{Algorithm::needle, {{0.9, 0.5, 0.7}, {0.5, 0.52, 0.74}, {0.71, 0.51, 0.72}}, {}};
  const std::vector<double> x = across(fill_chart({&mixed, 1}, "mixed"));
  ASSERT_EQ(x.size(), 3u);
  EXPECT_TRUE(std::is_sorted(x.begin(), x.end()));
}

TEST(Drawing, ChartKeepsEnamelsApart) {
  const std::vector<FillCurve> curves{{Algorithm::needle, {{0.5, 0.53, 0.78}, {0.9, 0.54, 0.74}}, "thin"},
                                      {Algorithm::needle, {{0.5, 0.49, 0.78}, {0.9, 0.51, 0.74}}, "thick"}};
  const std::string svg = fill_chart(curves, "both");
  EXPECT_EQ(times(svg, "fill=\"none\" stroke-width=\"2\""), 4u);
  EXPECT_EQ(times(svg, ">needle<"), 1u) << "one entry for the algorithm";
  EXPECT_EQ(times(svg, ">thin<") + times(svg, ">thick<"), 2u);
}

TEST(Drawing, LayersOfALatticeAreItsRows) {
  // Rows at 80° against the base, laid from the flank inwards.
  const double angle = -100 * std::acos(-1.0) / 180, rise = std::sqrt(3.0);
  const Point along{std::cos(angle), std::sin(angle)}, inwards{-along.y, along.x};
  std::vector<Point> wires;
  std::vector<int> expected;
  for (int row = 0; row < 4; ++row)
    for (int i = 0; i < 5; ++i) {
      wires.push_back((2.0 * i + row % 2) * along + (row * rise) * inwards);
      expected.push_back(row);
    }
  EXPECT_EQ(lattice_layers(1, angle, wires), expected);
  EXPECT_EQ(lattice_layers(1, angle + std::acos(-1.0), wires), expected) << "whichever way the rows run";
}

}  // namespace
}  // namespace bahnwerk::winding
