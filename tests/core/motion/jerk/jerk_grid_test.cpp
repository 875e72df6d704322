#include "core/motion/jerk/jerk_grid.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

TEST(JerkGrid, DivisionPointsRiseFromZeroToOne) {
  for (const Spread spread : {Spread::even, Spread::from_rest, Spread::to_rest, Spread::both}) {
    const Division d{8, spread};
    EXPECT_EQ(division_point(d, 0), 0);
    EXPECT_EQ(division_point(d, 8), 1);
    for (int i = 1; i <= 8; ++i) EXPECT_GT(division_point(d, i), division_point(d, i - 1));
  }
  EXPECT_LT(division_point({8, Spread::from_rest}, 1), 0.01);
  EXPECT_GT(division_point({8, Spread::to_rest}, 7), 0.99);
}

TEST(JerkGrid, CellsStayEndToEndWithinTheirSegments) {
  ContourBuilder b(2, {});
  b.line({30, 0, 0});
  b.arc({30, 10, 0}, {30, 5, 0}, true);
  b.line({0, 10, 0});
  const Contour contour = b.finish();
  const Machine machine = testing::two_axes();
  SilentProgress progress;
  ProgressScope stage_progress(progress, "planning", 0, 1);
  Grid<2> grid;
  const CartesianAxisPath axes(contour.path, 2);
  grid.build(LanePath<2>(axes), 0, contour.path.size(), contour.feeds(), machine, {}, stage_progress);
  const std::size_t before = grid.cells.size();
  LargeVector<Division> division(before, Division{3, Spread::even});
  division[0].spread = Spread::from_rest;
  divide<2>(grid, LanePath<2>(axes), division, stage_progress);
  ASSERT_EQ(grid.cells.size(), 3 * before);
  double length = 0;
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    ASSERT_GT(grid.length(c), 0);
    length += grid.length(c);
    if (c > 0 && grid.cells[c].segment == grid.cells[c - 1].segment)
      ASSERT_EQ(grid.right(c - 1).s, grid.left(c).s);
    else
      ASSERT_EQ(grid.left(c).s, 0);
  }
  EXPECT_NEAR(length, contour.path.length(), 1e-12 * length);
}

}  // namespace
}  // namespace bahnwerk
