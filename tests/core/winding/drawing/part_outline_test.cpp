#include "core/winding/drawing/part_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/winding/needle/rotor_obstacles.hpp"

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

}  // namespace
}  // namespace bahnwerk::winding
