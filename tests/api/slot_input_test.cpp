#include "api/slot/slot_input.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace bahnwerk::api {
namespace {

using nlohmann::json;

TEST(SlotInput, LengthsAreMillimetresAndAnglesDegrees) {
  const winding::StatorSlot s = stator_slot(json::parse(
      R"({"type":"stator","base_width":6,"opening_width":2,"height":16,"tip_angle":30,"base_radius":95,"liner":0.2})"));
  EXPECT_EQ(s.base_width, 6);
  EXPECT_EQ(s.height, 16);
  EXPECT_NEAR(s.tip_angle, std::numbers::pi / 6, 1e-15);
  EXPECT_EQ(s.liner, 0.2);
  EXPECT_EQ(s.wedge_width, 0) << "what is not given is not there";
  const winding::PolygonSlot p =
      polygon_slot(json::parse(R"({"points":[[0,0],[4,0],[4,5],[0,5]],"opening":[[1,5],[3,5]]})"));
  ASSERT_EQ(p.points.size(), 4u);
  EXPECT_EQ(p.points[2], (Point{4, 5}));
}

TEST(SlotInput, AbsentAndNullMembersKeepTheirValues) {
  const json document = json::parse(R"({"a":3,"b":null})");
  double a = 1, b = 1, c = 1;
  take(document, "a", a, 0.5);
  take(document, "b", b);
  take(document, "c", c);
  EXPECT_EQ(a, 1.5);
  EXPECT_EQ(b, 1);
  EXPECT_EQ(c, 1);
  EXPECT_FALSE(given<double>(document, "b"));
}

TEST(SlotInput, HeadsStandBehindTheSlotUnlessTheDocumentSaysWhere) {
  winding::StatorSlot slot;
  slot.base_radius = 95, slot.liner = 0.5;
  std::vector<InputFault> faults;
  const winding::StatorHeads usual = stator_heads(json::object(), slot, {"heads"}, faults);
  EXPECT_EQ(usual.base_radius, 95.5);
  EXPECT_GT(usual.tool_radius, 95.5);
  EXPECT_TRUE(faults.empty());
  stator_heads({{"tool_radius", 90}}, slot, {"heads"}, faults);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].place, (Place{"heads", "tool_radius"}));
  EXPECT_EQ(faults[0].message, "lies inside the slot's base, at 95.5 mm");
}

TEST(SlotInput, AWireIsOfTheStandardOrHasBothDiameters) {
  std::vector<InputFault> faults;
  const auto standard = read_wire(0.9, {"wire"}, 1, faults);
  ASSERT_TRUE(standard);
  EXPECT_EQ(standard->copper, 0.9);
  EXPECT_GT(standard->outer, 0.9);
  EXPECT_TRUE(faults.empty());
  EXPECT_FALSE(read_wire(0.91, {"wire"}, 1, faults));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].message, "is no standard wire; the nearest are 0.9 and 0.95, or give copper and outer diameter");
  faults.clear();
  const auto own = read_wire({{"copper", 0.5}, {"outer", 0.6}, {"tolerance", 0.04}}, {"wire"}, 1, faults);
  ASSERT_TRUE(own);
  EXPECT_EQ(own->tolerance, 0.04);
  EXPECT_TRUE(faults.empty());
  read_wire({{"copper", 0.5}, {"outer", 0.4}}, {"wire"}, 1, faults);
  read_wire({{"copper", 0.5}, {"outer", 1.6}}, {"wire"}, 1, faults);
  read_wire({{"copper", 0.5}, {"outer", 0.51}, {"tolerance", 0.04}}, {"wire"}, 1, faults);
  ASSERT_EQ(faults.size(), 3u);
  EXPECT_EQ(faults[0].place.back(), "outer");
  EXPECT_EQ(faults[2].place.back(), "tolerance");
}

}  // namespace
}  // namespace bahnwerk::api
