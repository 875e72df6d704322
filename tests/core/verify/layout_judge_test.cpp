#include "core/verify/layout_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/winding/slot.hpp"

namespace bahnwerk {
namespace {

using winding::Point;
using winding::Region;

Verification judge(const Region& room, double radius, const std::vector<Point>& wires, double overlap = 0,
                   std::size_t bound = 100) {
  const JudgedLayout layout{"any", 0.9, radius, overlap, wires, bound};
  SilentProgress silent;
  return judge_layouts(room, std::span(&layout, 1), silent, 0, 1);
}

Region square() {
  return Region({winding::line({0, 0}, {4, 0}), winding::line({4, 0}, {4, 4}), winding::line({4, 4}, {0, 4}),
                 winding::line({0, 4}, {0, 0})});
}

TEST(LayoutJudge, AcceptsWiresThatTouch) {
  const Verification verdict = judge(square(), 1, {{1, 1}, {3, 1}, {1, 3}, {3, 3}});
  EXPECT_TRUE(verdict.passed);
  ASSERT_EQ(verdict.checks.size(), 3u);
  for (const Check& check : verdict.checks) EXPECT_EQ(check.at, 0.9);
}

TEST(LayoutJudge, RefusesWiresThatOverlap) {
  const Verification verdict = judge(square(), 1, {{1, 1}, {2.999, 1}});
  EXPECT_FALSE(verdict.passed);
  EXPECT_NEAR(verdict.checks[0].value, 1e-3, 1e-12);
  EXPECT_TRUE(judge(square(), 1, {{1, 1}, {2.999, 1}}, 1.1e-3).passed);
}

TEST(LayoutJudge, RefusesWiresInTheWallAndOutside) {
  EXPECT_NEAR(judge(square(), 1, {{0.9, 1}}).checks[1].value, 0.1, 1e-12);
  EXPECT_FALSE(judge(square(), 1, {{0.9, 1}}).passed);
  EXPECT_NEAR(judge(square(), 1, {{-3, 2}}).checks[1].value, 4, 1e-12) << "3 mm outside of the wall and 1 mm of radius";
  EXPECT_NEAR(judge(square(), 1, {{8, 8}}).checks[1].value, 1 + std::hypot(4, 4), 1e-12);
}

TEST(LayoutJudge, RefusesMoreThanTheBoundAndNotANumber) {
  EXPECT_FALSE(judge(square(), 0.5, {{1, 1}, {3, 3}}, 0, 1).passed);
  EXPECT_FALSE(judge(square(), 0.5, {{1, std::numeric_limits<double>::quiet_NaN()}}).passed);
}

// Its distances are computed in another way than those of the planners.
TEST(LayoutJudge, AgreesWithTheRegionAboutClearances) {
  const winding::Slot slot = make_slot(winding::RotorSlot{});
  for (double x = -4; x < 17; x += 0.37)
    for (double y = -1; y < 6; y += 0.31) {
      const double beyond = judge(slot.room, 0.6, {{x, y}}).checks[1].value;
      EXPECT_NEAR(beyond, 0.6 - slot.room.distance({x, y}), 1e-9) << x << ' ' << y;
    }
}

TEST(LayoutJudge, JudgesAnEmptyLayout) { EXPECT_TRUE(judge(square(), 3, {}).passed); }

}  // namespace
}  // namespace bahnwerk
