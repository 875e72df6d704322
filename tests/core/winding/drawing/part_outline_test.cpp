#include "core/winding/drawing/part_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/winding/needle/rotor_obstacles.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

// What is drawn is the surface that the needle must not touch.
template <class Part, class Iron>
void expect_on(const Part& part, const Iron& iron, int count, double low, double high) {
  const std::vector<Polyline3> lines = part_outline(part, checked_slot(part));
  EXPECT_EQ(lines.size(), static_cast<std::size_t>(count) * (2 * 2 + 2 * 2));
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const Polyline3& line : lines) {
    ASSERT_GE(line.size(), 2u);
    for (const Vec p : line) {
      EXPECT_NEAR(iron.section_distance({p.x, p.y, p.z}), 0, 1e-9);
      least = std::min(least, p.z), most = std::max(most, p.z);
    }
  }
  EXPECT_EQ(least, low);
  EXPECT_EQ(most, high);
  // Each section's lines close one loop: the end of one is the begin of another.
  for (const Polyline3& line : lines) {
    if (line.front().z != line.back().z) continue;
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                            [&](const Polyline3& other) {
                              return norm(other.front() - line.back()) < 1e-9 && other.front().z == other.back().z;
                            }),
              1);
  }
}

TEST(PartOutline, LiesOnTheStack) {
  for (const int slots : {12, 48}) {
    StatorPart part;
    part.slots = slots;
    expect_on(part, StatorIron(part, checked_slot(part)), slots, 0, 210);
  }
}

TEST(PartOutline, LiesOnThePoles) {
  for (const int poles : {2, 6}) {
    RotorPart part;
    part.poles = poles;
    expect_on(part, RotorIron(part, checked_slot(part)), poles, -10.6, 202 + 10.6);
  }
}

// Posts are drawn where the needle must not touch them.
TEST(PartOutline, PostsAreThoseOfTheWindingTools) {
  const StatorPart part;
  const ToolPost post;
  for (const Coil coil : {Coil{0, 5}, Coil{7, -4}}) {
    const std::vector<Block> blocks = tool_posts(part, post, coil);
    const std::vector<Polyline3> lines = post_outline(part, post, coil);
    EXPECT_EQ(lines.size(), 4u * 6);
    for (const Polyline3& line : lines)
      for (const Vec p : line) {
        double nearest = HUGE_VAL;
        for (const Block& block : blocks) nearest = std::min(nearest, std::abs(block.distance(p)));
        EXPECT_NEAR(nearest, 0, 1e-9);
      }
  }
}

TEST(PartOutline, CoilsAreMarkedAtTheirSlots) {
  const StatorPart part;
  const std::vector<SlotLabel> slots = slot_labels(part, {{46, 5}});
  ASSERT_EQ(slots.size(), 48u);
  for (const SlotLabel& label : slots) {
    EXPECT_EQ(label.marked, label.slot == 46 || label.slot == 3);
    EXPECT_NEAR(std::remainder(azimuth(label.at) - label.slot * part.pitch(), 2 * std::numbers::pi), 0, 1e-9);
  }
  for (const Polyline3& line : coil_outline(part, checked_slot(part), {46, 5}))
    for (const Vec p : line) {
      const double at = azimuth(p) / part.pitch();
      EXPECT_LT(std::min(std::abs(std::remainder(at - 46, 48)), std::abs(std::remainder(at - 3, 48))), 0.5);
    }
  const RotorPart rotor;
  const std::vector<SlotLabel> gaps = slot_labels(rotor, {{1, -1}});
  ASSERT_EQ(gaps.size(), 6u);
  EXPECT_TRUE(gaps[0].marked && gaps[1].marked && !gaps[2].marked);
  EXPECT_NEAR(azimuth(gaps[1].at), rotor.pitch() / 2, 1e-9) << "between poles 0 and 1";
  for (const Polyline3& line : coil_outline(rotor, checked_slot(rotor), {1, -1}))
    for (const Vec p : line) EXPECT_LT(std::abs(azimuth(p)), rotor.pitch() / 2 + 1e-9) << "pole 0";
}

}  // namespace
}  // namespace bahnwerk::winding
