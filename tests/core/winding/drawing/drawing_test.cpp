#include "core/winding/drawing/drawing.hpp"

#include <gtest/gtest.h>

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

TEST(Drawing, HasALegendOfWhatItShows) {
  const std::string plain = slot_drawing(box(), {"plain", 1, 1.8, {{1, 1}}, {}});
  for (const char* words : {"copper 1.8 mm, 2 with enamel", "order of laying", "layer", "0.5 mm"})
    EXPECT_EQ(times(plain, words), 1u) << words;
  for (const char* words : {"liner", "wedge", "tooth tip", "opening", "does not stay", "reach", "other coil side"})
    EXPECT_EQ(times(plain, words), 0u) << words;
  DrawnWires drawn{"stator", 0.5, 0.9, {{0, 1}, {0, 3}}, {1}};
  drawn.unreached = 0;
  Slot stator = make_slot(StatorSlot{});
  stator = shared(stator, Sharing::beside).slot;
  const std::string all = slot_drawing(stator, drawn);
  for (const char* words :
       {"liner", "wedge", "tooth tip", "3.083 mm clear", "does not stay", "reach", "other coil side"})
    EXPECT_EQ(times(all, words), 1u) << words;
}

TEST(Drawing, OfNoWiresIsTheSlot) {
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

}  // namespace
}  // namespace bahnwerk::winding
