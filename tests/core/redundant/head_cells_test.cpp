#include "core/redundant/head_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/acceleration/acceleration_limited.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk {
namespace {

PathMotion head_of(Contour contour, const Machine& machine) {
  const auto kept = std::make_shared<const Contour>(std::move(contour));
  SilentProgress progress;
  return {contour_axes(kept, 2), plan_acceleration_limited(*kept, machine, {}, progress).law};
}

HeadCellOptions options_of(const Machine& machine) {
  HeadCellOptions o;
  o.longest = 2e-3;
  for (const AxisLimits& axis : machine.axes) {
    o.held.push_back(axis);
    o.acceleration_change.push_back(3000);
    o.jerk_change.push_back(unlimited);
  }
  return o;
}

TEST(HeadCells, HoldWhatTheHeadDoes) {
  const Machine machine = summed(test::md2());
  const PathMotion head = head_of(test::holes(3, 2, 20, 4), machine);
  const HeadCells cells = head_cells(head, options_of(machine), silent_scope());
  ASSERT_GT(cells.size(), 100u);
  ASSERT_EQ(cells.pieces.size(), cells.size());
  EXPECT_EQ(cells.times.front(), 0);
  EXPECT_EQ(cells.times.back(), head.duration());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const double begin = cells.times[c], end = cells.times[c + 1];
    ASSERT_LT(begin, end);
    EXPECT_LE(end - begin, 2e-3 * (1 + 1e-9));
    for (std::size_t a = 0; a < 2; ++a) {
      const MotionState at = head.in_piece(cells.pieces[c], begin);
      EXPECT_EQ(cells.nodes[a][c].x, at.position[a]);
      EXPECT_EQ(cells.nodes[a][c].v, at.velocity[a]);
      const Range& r = cells.cells[a][c].acceleration;
      EXPECT_LE(r.width(), 3000 * (1 + 1e-9));
      for (int i = 1; i < 20; ++i) {
        const double x = head.evaluate(begin + (end - begin) * i / 20).acceleration[a];
        EXPECT_GE(x, r.lowest - 1e-6 * 76000);
        EXPECT_LE(x, r.highest + 1e-6 * 76000);
      }
    }
  }
}

TEST(HeadCells, BreakWhereTheHeadSwitchesFromDrivingToBraking) {
  const Machine machine = summed(test::md2());
  const PathMotion head = head_of(test::straight(19, 0), machine);  // √(19/76000) s each
  const HeadCells cells = head_cells(head, options_of(machine), silent_scope());
  const double middle = std::sqrt(19.0 / 76000);
  bool found = false;
  for (const double t : cells.times) found = found || std::abs(t - middle) < 1e-9;
  EXPECT_TRUE(found);
  for (const HeadCell& cell : cells.cells[0]) {
    EXPECT_NEAR(std::abs(cell.acceleration.middle()), 76000, 1e-3);
    EXPECT_LT(cell.acceleration.width(), 1e-3);
  }
}

TEST(HeadCells, OfSomePiecesAreThoseOfTheWhole) {
  const Machine machine = summed(test::md2());
  const PathMotion head = head_of(test::holes(2, 2, 20, 4), machine);
  const std::size_t first = head.pieces() / 3, last = head.pieces() / 2;
  const HeadCells part = head_cells(head, first, last, options_of(machine), silent_scope());
  EXPECT_EQ(part.times.front(), head.begin(first));
  EXPECT_EQ(part.times.back(), head.end(last - 1));
  for (const auto& nodes : part.nodes) EXPECT_EQ(nodes.size(), part.size() + 1);
}

}  // namespace
}  // namespace bahnwerk
