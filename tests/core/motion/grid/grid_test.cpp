#include "core/motion/grid/grid.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

Contour mixed() {
  ContourBuilder b(2, {});
  b.line({100, 0, 0});
  b.arc({100, 20, 0}, {100, 10, 0}, true);
  b.polynomial({{100, -30, -4, 9}, {20, 0, 8, -3}});
  return b.finish();
}

Grid<2> grid_of(const Contour& contour, const GridOptions& options = {}) {
  Grid<2> grid;
  Progress progress;
  ProgressScope stage_progress(progress, "planning");
  const CartesianAxisPath axes(contour.path, 2);
  grid.build(LanePath<2>(axes), 0, contour.path.size(), {bahnwerk::testing::two_axes(), contour.feeds()}, options,
             stage_progress);
  return grid;
}

TEST(Grid, CellsJoinUpAndCoverEverySegment) {
  const Contour contour = mixed();
  const Grid<2> grid = grid_of(contour);
  std::size_t segment = 0;
  double length = 0;
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    if (grid.cells[c].segment != segment) {
      EXPECT_NEAR(length, contour.path[segment].length(), 1e-12 * length);
      segment = grid.cells[c].segment;
      length = 0;
    }
    ASSERT_GT(grid.length(c), 0);
    length += grid.length(c);
  }
  EXPECT_EQ(segment, contour.path.size() - 1);
  EXPECT_TRUE(grid.cells[0].straight);
  EXPECT_EQ(grid.left(1).u, contour.path[1].curve().begin());
}

/// Next to a vanishing tangent s ~ ρ²: equal steps of the parameter are no steps of a rounded path length.
TEST(Grid, CellsNextToAVanishingTangentAreResolvedByPathLengthAtBothEnds) {
  const Vec p{3, 1, 0}, q{11, 6, 0}, r{17, -2, 0};
  double nearest[2] = {};
  for (const bool at_end : {false, true}) {
    ContourBuilder b(2, at_end ? r : p);
    b.nurbs(3, at_end ? std::vector<Vec>{r, q, p, p} : std::vector<Vec>{p, p, q, r}, {}, {0, 0, 0, 0, 1, 1, 1, 1});
    const Contour contour = b.finish();
    const Grid<2> grid = grid_of(contour);
    const double length = contour.path.length();
    for (std::size_t c = 0; c < grid.cells.size(); ++c) ASSERT_GT(grid.length(c), shortest_cell * length) << c;
    EXPECT_NEAR(grid.right(grid.cells.size() - 1).s, length, 1e-15 * length);
    nearest[at_end] = grid.length(at_end ? grid.cells.size() - 1 : 0);
    EXPECT_LT(nearest[at_end], 1e-10 * length);
  }
  EXPECT_NEAR(nearest[0], nearest[1], 0.01 * nearest[0]);
}

/// x and y turn round at one place, which is found of each by itself and differs by rounding.
TEST(Grid, AxesThatTurnTogetherPartACellOnce) {
  const Machine machine{{{"x", 500, 2000}, {"y", 500, 2000}, {"z", 500, 2000}}, 0.001};
  for (int i = 0; i < 200; ++i) {
    const double u = 0.2 + 0.6 * i / 200, x = 7 + 0.01 * i, y = 3 - 0.011 * i;  // x (u − u₀)², y (u − u₀)², linear z
    ContourBuilder b(3, {});
    b.line({-x * 2 * u, -y * 2 * u, -10});
    b.polynomial({{-x * 2 * u, -x * 2 * u, x}, {-y * 2 * u, -y * 2 * u, y}, {-10, 30, 0}});
    const Contour contour = b.finish();
    Grid<3> grid;
    Progress progress;
    ProgressScope stage_progress(progress, "planning");
    const CartesianAxisPath axes(contour.path, 3);
    grid.build(LanePath<3>(axes), 0, contour.path.size(), {machine, contour.feeds()}, {}, stage_progress);
    for (std::size_t c = 0; c < grid.cells.size(); ++c) ASSERT_GT(grid.length(c), 1e-6) << i << ", cell " << c;
  }
}

TEST(Grid, CellsTurnLittleAndModelTheCurvature) {
  const Contour contour = mixed();
  const GridOptions options;
  const Grid<2> grid = grid_of(contour, options);
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    if (grid.cells[c].straight) continue;
    const auto &l = grid.left(c), &r = grid.right(c);
    const double turn = std::hypot(r.d1[0] - l.d1[0], r.d1[1] - l.d1[1]);
    EXPECT_LT(turn, 2 * options.angle);
    const Segment& segment = contour.path[grid.cells[c].segment];
    const double u = 0.5 * (l.u + r.u), h = grid.length(c), x = (segment.travelled(u) - l.s) / h, y = 1 - x;
    const PathPoint mid = segment.at_parameter(u);
    for (std::size_t k = 0; k < 2; ++k) {
      const double model =
          y * y * (1 + 2 * x) * l.d2[k] + x * x * (1 + 2 * y) * r.d2[k] + h * x * y * (y * l.d3[k] - x * r.d3[k]);
      EXPECT_NEAR(model, mid.d2[k], 5 * options.hermite * norm(mid.d2) + 1e-14);
    }
  }
}

TEST(Grid, StationsLieWhereAnAxisTurnsRound) {
  ContourBuilder b(2, {10, 0, 0});
  b.arc({10, 0, 0}, {0, 0, 0}, true);
  const Grid<2> grid = grid_of(b.finish());
  int found = 0;
  for (const auto& s : grid.stations)
    for (std::size_t k = 0; k < 2; ++k) found += std::abs(s.d1[k]) < 1e-12;
  EXPECT_GE(found, 5);  // both ends count once each
}

TEST(Grid, DivideKeepsTheEnds) {
  const Contour contour = mixed();
  Grid<2> grid = grid_of(contour);
  const std::size_t n = grid.cells.size();
  LargeVector<std::uint8_t> parts(n, 1);
  parts[1] = 5;
  parts[n - 1] = 2;
  const double left = grid.left(1).s, right = grid.right(1).s;
  Progress progress;
  ProgressScope stage_progress(progress, "planning");
  const CartesianAxisPath axes(contour.path, 2);
  grid.divide(LanePath<2>(axes), parts, stage_progress);
  EXPECT_EQ(grid.cells.size(), n + 5);
  EXPECT_EQ(grid.left(1).s, left);
  EXPECT_EQ(grid.right(5).s, right);
  EXPECT_EQ(grid.right(grid.cells.size() - 1).u, contour.path[contour.path.size() - 1].curve().end());
}

TEST(Grid, OneTinyCurveBetweenRestsStillMoves) {
  ContourBuilder b(2, {});
  b.arc({1e-4, 0, 0}, {5e-5, -1, 0}, false);
  const Contour contour = b.finish();
  const Grid<2> grid = grid_of(contour);  // a single cell could not move between its two rests
  EXPECT_GE(grid.cells.size(), 8u);
  EXPECT_LT(grid.length(0), grid.length(3));
}

}  // namespace
}  // namespace bahnwerk
