// Where pieces end. What they are worth is tested with the bound.
#include "core/verify/bound/jerk_pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/progress.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/verify/bound/bound_solver.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk::verify {
namespace {

using reference::Maker;

TEST(JerkPieces, AdvanceWhereTheParameterDoesNotGrowLikeLength) {
  // Its speed by the parameter grows fiftyfold.
  const Contour contour = Maker().bezier({{0.5, 0}, {3, 3}, {30, 40}}).done();
  Machine machine = reference::machine(2, 1800, 16000);
  for (AxisLimits& axis : machine.axes) axis.jerk = 1e6;
  const CartesianAxisPath path(contour.path, 2);
  const PathTask task = contour_task(path, contour, machine);
  Progress silent;
  ProgressScope progress(silent, "pieces");
  for (const double wider : {1.0, 8.0}) {
    BoundGrid<2> grid(path, machine, task.feeds, 0.03, progress);
    grid.widen(wider);
    grid.build(0, path.size());
    BoundSolver<2> solver(grid, progress);
    solver.solve();
    const std::vector<double> b = solver.speed_squares(grid.order().size());
    JerkPieces<2> pieces(grid, machine.cycle_time, {1e6, 1e6}, progress);
    for (const bool fine : {false, true}) {
      constexpr double first_piece = 1e-3;
      pieces.begin(b, true, true, 1e-4, first_piece, fine);
      std::size_t count = 0;
      double length = 0, shortest = contour.path.length();
      for (; pieces.has(count); ++count) {
        const double piece = pieces.list()[count].length;
        length += piece, shortest = std::min(shortest, piece);
      }
      EXPECT_NEAR(length, contour.path.length(), 1e-9);
      EXPECT_GT(shortest, first_piece / 32) << wider << ' ' << fine << ' ' << count;
    }
  }
}

}  // namespace
}  // namespace bahnwerk::verify
