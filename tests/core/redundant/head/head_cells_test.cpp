#include "core/redundant/head/head_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk {
namespace {

PathMotion head_of(Contour contour, const Machine& machine) {
  const auto kept = std::make_shared<const Contour>(std::move(contour));
  Progress progress;
  return {contour_axes(kept, 2), plan_acceleration_limited(*kept, machine, {}, progress).law};
}

HeadCellOptions options_of(const Machine& machine) {
  HeadCellOptions o;
  o.longest = 2e-3;
  for (const AxisLimits& axis : machine.axes) {
    o.held.push_back(axis);
    o.acceleration_change.push_back(3000);
    o.jerk_change.push_back(unlimited);
    o.jerk_range.push_back(unlimited);
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
      EXPECT_EQ(cells.nodes[a][c].x, at[0][a]);
      EXPECT_EQ(cells.nodes[a][c].v, at[1][a]);
      const Range& r = cells.cells[a][c].acceleration;
      EXPECT_LE(r.width(), 3000 * (1 + 1e-9));
      for (int i = 1; i < 20; ++i) {
        const double x = head.evaluate(begin + (end - begin) * i / 20)[2][a];
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

TEST(HeadCells, WithLimitedJerkBreakWhereTheAccelerationJumps) {
  const Machine machine = summed(test::with_jerk(test::md2(), 100));
  const auto kept = std::make_shared<const Contour>(test::slot(3, 2, 300));
  Progress progress;
  const PathMotion head(contour_axes(kept, 2), plan_jerk_limited(*kept, machine, {}, progress).law);
  HeadCellOptions options = options_of(machine);
  for (std::size_t k = 0; k < 2; ++k) {
    options.acceleration_change[k] = unlimited;
    options.jerk_change[k] = 240;
    options.jerk_range[k] = 6e6;
  }
  const HeadCells cells = head_cells(head, options, silent_scope());
  std::size_t jumps = 0;
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_LE(cells.cells[k][c].jerk.width(), 6e6 * (1 + 1e-9));
      const HeadNode& node = cells.nodes[k][c];
      jumps += std::abs(node.a_jump) > 100;
      if (c == 0) continue;
      const std::size_t piece = cells.pieces[c];
      const double before = head.in_piece(piece - 1, head.end(piece - 1))[2][k];
      if (head.begin(piece) == cells.times[c]) {
        EXPECT_NEAR(node.a - node.a_jump, before, 1e-6 * 76000);
      }
    }
  EXPECT_GE(jumps, 3u);
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
