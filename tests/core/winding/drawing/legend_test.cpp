#include "core/winding/drawing/legend.hpp"

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

}  // namespace
}  // namespace bahnwerk::winding
