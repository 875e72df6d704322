#include "core/winding/needle/clearance_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/progress.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

Progress silent;

TEST(ClearanceMap, ATipInTheMiddleHasHalfOfWhatTheOpeningLeaves) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  for (const double height : {3.0, 8.0, 15.0})
    for (const std::optional<double> limit : {std::optional<double>{}, std::optional<double>{0.35}})
      EXPECT_NEAR(tip_clearance(part, iron, {2.6, 60}, {0, height}, limit, 1e-6), (3.083 - 2.6) / 2, 1e-6) << height;
}

// A needle that does not swivel: its axis leads from the stator's axis through the tip past the tooth tip's half
// circle.
TEST(ClearanceMap, ToothTipDecidesBesideTheMiddleWithoutShift) {
  const StatorPart part;
  const StatorIron iron(part, checked_slot(part));
  for (const double x : {0.2, 0.8, -0.8, 1.5}) {
    const Point tip{x, 6};
    const NeedlePose pose = tip_pose(part, tip, std::nullopt);
    EXPECT_NEAR(norm(pose.tip - Vec3{95.7 - 6, x, 105}), 0, 1e-12);
    const Vec3 d = pose.direction(), centre{95.7 - 16.129 - 0.3, std::copysign(3.683 / 2, x), 105};
    EXPECT_NEAR(d.y * pose.tip.x, d.x * pose.tip.y, 1e-9) << "along a radius";
    const double beside = norm(cross(centre - pose.tip, d)) - 0.3 - 1.3;
    EXPECT_NEAR(tip_clearance(part, iron, {2.6, 60}, tip, std::nullopt, 1e-6), beside, 1e-6);
  }
}

TEST(ClearanceMap, PivotShiftOpensTheLowerTwoThirds) {
  const StatorPart part;
  const Slot slot = checked_slot(part);
  const NeedleShape needle{2.6, 60};
  const ClearanceMap straight = clearance_map(part, slot, needle, std::nullopt, 0.4, silent),
                     shifted = clearance_map(part, slot, needle, 0.35, 0.4, silent);
  ASSERT_EQ(straight.values.size(), straight.columns * straight.rows);
  ASSERT_EQ(straight.values.size(), shifted.values.size());
  std::size_t inside = 0;
  for (std::size_t row = 0; row < straight.rows; ++row)
    for (std::size_t column = 0; column < straight.columns; ++column) {
      const double a = straight.at(column, row), b = shifted.at(column, row);
      const Point tip = straight.middle(column, row);
      EXPECT_EQ(std::isnan(a), slot.iron.distance(tip) < 0);
      EXPECT_EQ(std::isnan(a), std::isnan(b));
      if (std::isnan(a)) continue;
      ++inside;
      EXPECT_NEAR(a, straight.at(straight.columns - 1 - column, row), 2e-3) << "symmetric";
      EXPECT_NEAR(b, shifted.at(straight.columns - 1 - column, row), 2e-3);
    }
  EXPECT_GT(inside, 300u);
  // [Herrmann 4.2.6]: full access in the lower two thirds; here, of places that half a needle fits beside.
  std::size_t full = 0, reached = 0;
  for (std::size_t row = 0; row < shifted.rows; ++row)
    for (std::size_t column = 0; column < shifted.columns; ++column) {
      const Point tip = shifted.middle(column, row);
      if (tip.y > 2 / 3.0 * part.slot.height || std::isnan(shifted.at(column, row))) continue;
      double flank = 1e9;
      for (const Edge& e : slot.iron.edges())
        if (e.straight() && std::abs(e.direction(0).y) > 0.9)
          flank = std::min(flank, distance(tip, e.at(e.nearest(tip))));
      if (flank < needle.width / 2) continue;
      ++full;
      EXPECT_GE(shifted.at(column, row), 0);
      reached += straight.at(column, row) >= 0;
    }
  EXPECT_GT(full, 100u);
  EXPECT_LT(reached, full / 2) << "without shift";
  EXPECT_GT(shifted.share(0), 1.8 * straight.share(0));
  EXPECT_GT(shifted.share(0), 0.5);
  EXPECT_LE(shifted.share(0.1), shifted.share(0));
  EXPECT_EQ(shifted.share(1), 0);
  EXPECT_EQ(ClearanceMap{}.share(0), 0);
}

TEST(ClearanceMap, ImpossibleCellsAreRefused) {
  const StatorPart part;
  const Slot slot = checked_slot(part);
  for (const double step : {0.0, -1.0, 1e-5, std::nan("")})
    EXPECT_THROW(clearance_map(part, slot, {2.6, 60}, std::nullopt, step, silent), std::invalid_argument) << step;
}

}  // namespace
}  // namespace bahnwerk::winding
