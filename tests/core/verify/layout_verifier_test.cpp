#include "core/verify/layout_verifier.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/slot/slot.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

Verification verify_motion(const Region& usable_area, double radius, const std::vector<Point>& wires,
                           double overlap = 0, std::size_t bound = 100) {
  const LayoutToVerify layout{"any", 0.9, radius, overlap, wires, bound};
  Progress silent;
  return verify_layouts(usable_area, std::span(&layout, 1), silent);
}

Region square() {
  return Region({bahnwerk::line({0, 0}, {4, 0}), bahnwerk::line({4, 0}, {4, 4}), bahnwerk::line({4, 4}, {0, 4}),
                 bahnwerk::line({0, 4}, {0, 0})});
}

TEST(LayoutJudge, AcceptsWiresThatTouch) {
  const Verification verdict = verify_motion(square(), 1, {{1, 1}, {3, 1}, {1, 3}, {3, 3}});
  EXPECT_TRUE(verdict.passed);
  ASSERT_EQ(verdict.checks.size(), 3u);
  for (const Check& check : verdict.checks) EXPECT_EQ(check.at, 0.9);
}

TEST(LayoutJudge, RefusesWiresThatOverlap) {
  const Verification verdict = verify_motion(square(), 1, {{1, 1}, {2.999, 1}});
  EXPECT_FALSE(verdict.passed);
  EXPECT_NEAR(verdict.checks[0].value, 1e-3, 1e-12);
  EXPECT_TRUE(verify_motion(square(), 1, {{1, 1}, {2.999, 1}}, 1.1e-3).passed);
}

TEST(LayoutJudge, RefusesWiresInTheWallAndOutside) {
  EXPECT_NEAR(verify_motion(square(), 1, {{0.9, 1}}).checks[1].value, 0.1, 1e-12);
  EXPECT_FALSE(verify_motion(square(), 1, {{0.9, 1}}).passed);
  EXPECT_NEAR(verify_motion(square(), 1, {{-3, 2}}).checks[1].value, 4, 1e-12)
      << "3 mm outside of the wall and 1 mm of radius";
  EXPECT_NEAR(verify_motion(square(), 1, {{8, 8}}).checks[1].value, 1 + std::hypot(4, 4), 1e-12);
}

TEST(LayoutJudge, RefusesMoreThanTheBoundAndNotANumber) {
  EXPECT_FALSE(verify_motion(square(), 0.5, {{1, 1}, {3, 3}}, 0, 1).passed);
  EXPECT_FALSE(verify_motion(square(), 0.5, {{1, std::numeric_limits<double>::quiet_NaN()}}).passed);
}

// Its distances are computed in another way than those of the planners.
TEST(LayoutJudge, AgreesWithTheRegionAboutClearances) {
  const winding::Slot slot = make_slot(winding::RotorSlot{});
  for (double x = -4; x < 17; x += 0.37)
    for (double y = -1; y < 6; y += 0.31) {
      const double beyond = verify_motion(slot.usable_area, 0.6, {{x, y}}).checks[1].value;
      EXPECT_NEAR(beyond, 0.6 - slot.usable_area.distance({x, y}), 1e-9) << x << ' ' << y;
    }
}

TEST(LayoutJudge, LooksAtEveryRegionInItsOwnRoom) {
  const Region head({bahnwerk::line({0, 0}, {9, 0}), bahnwerk::line({9, 0}, {9, 9}), bahnwerk::line({9, 9}, {0, 9}),
                     bahnwerk::line({0, 9}, {0, 0})});
  const auto verdict = [&](const std::vector<Point>& first, const std::vector<Point>& second) {
    LayoutToVerify layouts[] = {{"any", 0.9, 1, 0, first, 9}, {"any", 0.9, 1, 0, second, 9}};
    layouts[1].region = "head";
    layouts[1].usable_area = &head;
    layouts[1].count = first.size();
    Progress silent;
    return verify_layouts(square(), layouts, silent);
  };
  EXPECT_TRUE(verdict({{1, 1}, {3, 1}}, {{8, 8}, {6, 8}}).passed);
  EXPECT_FALSE(verdict({{1, 1}, {3, 1}}, {{8.1, 8}, {6, 8}}).passed) << "in the head's wall";
  EXPECT_FALSE(verdict({{1, 1}, {3, 1}}, {{8, 8}, {6.1, 8}}).passed) << "an overlap in the head";
  const Verification missing = verdict({{1, 1}, {3, 1}}, {{8, 8}});
  EXPECT_FALSE(missing.passed);
  for (const Check& check : missing.checks) EXPECT_EQ(check.passed, check_name(check) != "wires missing any, head");
}

TEST(LayoutJudge, CountAboveTheBoundFailsTheCheckOfThatName) {
  const Verification verdict = verify_motion(square(), 0.5, {{1, 1}, {3, 3}}, 0, 1);
  ASSERT_EQ(check_name(verdict.checks.back()), "bound");
  EXPECT_FALSE(verdict.checks.back().passed);
  EXPECT_EQ(verdict.checks.back().value, 1);
}

TEST(LayoutJudge, FindsTheDeepestOverlapOfAllPairs) {
  Random random(3);
  for (int k = 0; k < 50; ++k) {
    std::vector<Point> wires;
    double least = 2;
    for (std::size_t i = 0; i < 30; ++i) {
      wires.push_back({random.uniform(-20, 20), random.uniform(-20, 20)});
      for (std::size_t j = 0; j < i; ++j)
        least = std::min(least, std::hypot(wires[i].x - wires[j].x, wires[i].y - wires[j].y));
    }
    EXPECT_NEAR(verify_motion(square(), 1, wires).checks[0].value, 2 - least, 1e-15);
  }
}

TEST(LayoutJudge, VerifiesAnEmptyLayout) { EXPECT_TRUE(verify_motion(square(), 3, {}).passed); }

}  // namespace
}  // namespace bahnwerk
