#include "core/winding/drawing/clearance_drawing.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/progress.hpp"

namespace bahnwerk::winding {
namespace {

Progress silent;

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(ClearanceDrawing, HasBothMapsAndWhatTheirColoursMean) {
  const StatorPart part;
  const Slot slot = checked_slot(part);
  const NeedleShape needle{2.6, 60};
  const std::vector<DrawnClearance> maps{
      {"without pivot shift", clearance_map(part, slot, needle, std::nullopt, 0.5, silent)},
      {"with < 20°", clearance_map(part, slot, needle, 0.35, 0.5, silent)}};
  const std::string svg = clearance_drawing(StatorIron(part, slot), maps, "needle 2.6 mm & slot 3.08 mm");
  EXPECT_EQ(svg.find("nan"), svg.npos);
  EXPECT_EQ(times(svg, "<clipPath"), 4u) << "of each map its frame, and the slot's outline for the cells";
  EXPECT_EQ(times(svg, "_outline)"), 2u);
  EXPECT_EQ(times(svg, "of the slot accessible"), 2u);
  EXPECT_NE(svg.find("with &lt; 20°"), svg.npos);
  EXPECT_NE(svg.find("needle 2.6 mm &amp; slot"), svg.npos);
  // At least one rectangle per row of each map, fewer than cells.
  EXPECT_GT(times(svg, "<rect"), 2 * maps[0].map.rows);
  EXPECT_LT(times(svg, "<rect"), maps[0].map.rows * maps[0].map.columns);
  EXPECT_GT(times(svg, "#c1121f"), 10u) << "where it does not fit";
  EXPECT_EQ(svg, clearance_drawing(StatorIron(part, slot), maps, "needle 2.6 mm & slot 3.08 mm"));
}

TEST(ClearanceDrawing, IsADrawingWithoutMapsAndWithEmptyOnes) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  for (const std::vector<DrawnClearance>& maps : {std::vector<DrawnClearance>{}, {{"empty", {}}}}) {
    const std::string svg = clearance_drawing(iron, maps, "none");
    EXPECT_NE(svg.find("</svg>"), svg.npos);
    EXPECT_EQ(svg.find("nan"), svg.npos);
    EXPECT_EQ(svg.find("inf"), svg.npos);
  }
}

}  // namespace
}  // namespace bahnwerk::winding
