// Solving again only where a grid was refined gives what solving all of it gives, and nothing that is kept moves.
#include "core/verify/bound/bound_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/progress.hpp"
#include "tests/core/motion/axes/five_axes.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk::verify {
namespace {

using reference::machine;
using reference::Maker;

/// Refines at random, and what mark_switching() says.
template <int N>
void expect_the_same(const AxisPath& path, const Machine& m, const std::vector<double>& feeds, unsigned seed) {
  Progress silent;
  ProgressScope progress(silent, "bound");
  BoundGrid<N> grid(path, m, feeds, 2e-3, progress);
  BoundSolver<N> solver(grid, progress);
  grid.build(0, path.size());
  solver.solve();
  std::mt19937_64 random(seed);
  std::vector<unsigned char> marked;
  for (int round = 0; round < 4; ++round) {
    solver.mark_switching(solver.duration(), marked);
    if (round % 2 == 1)
      for (unsigned char& mark : marked) mark = random() % 16 == 0;
    const std::vector<std::uint32_t> before = grid.order();
    std::vector<double> places;
    for (const BoundNode<N>& node : grid.nodes()) places.push_back(node.s);
    grid.refine(marked);
    std::size_t at = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {  // all are still there, in their order
      while (at < grid.order().size() && grid.order()[at] != before[i]) ++at;
      ASSERT_LT(at, grid.order().size());
      EXPECT_EQ(grid.nodes()[at].s, places[i]);
    }
    solver.solve_changes();
    BoundSolver<N> fresh(grid, progress);
    fresh.solve();
    for (const std::uint32_t id : grid.order()) EXPECT_EQ(solver.speed_square(id), fresh.speed_square(id));
    for (std::size_t i = 0; i + 1 < grid.order().size(); ++i)
      EXPECT_EQ(solver.cell_time(grid.order()[i]), fresh.cell_time(grid.order()[i]));
    EXPECT_EQ(solver.duration(), fresh.duration());
  }
}

TEST(BoundSolver, ChangesAreSolvedToTheLastBit) {
  for (unsigned i = 0; i < 40; ++i) {
    std::mt19937_64 random(700 + i);
    const Contour contour = reference::random_contour(random, 1 + static_cast<int>(i % 8), i % 2, i % 5 ? 1e3 : 150);
    Machine m = machine(2, i % 3 ? unlimited : 300, 16000);
    if (i % 4 == 1) m.axes[0].acceleration = 3000;
    expect_the_same<2>(CartesianAxisPath(contour.path, 2), m, contour.feeds(), i);
    expect_the_same<2>(CartesianAxisPath(contour.path, 1), m, contour.feeds(), i);
  }
}

TEST(BoundSolver, RefinedSolutionsEqualCompleteOnesInSpaceAndThroughKinematics) {
  const Contour space = Maker(3, {10, 0, 0})
                            .arc({0, 10, 3}, {0, 0, 0}, true)
                            .bezier({{-5, 15, 8}, {-10, 10, 12}, {10, 5, 0}}, {1, 0.5, 2, 1})
                            .done();
  expect_the_same<3>(CartesianAxisPath(space.path, 3), machine(3, 500, 16000), space.feeds(), 1);
  const test::FiveAxes kinematics;
  const Contour plane = Maker().line({40, 0}).arc({60, 20}, {40, 20}, true).line({60, 45}).done();
  expect_the_same<8>(KinematicAxisPath(plane.path, kinematics), {kinematics.axes(), 0.001}, plane.feeds(), 2);
}

TEST(BoundSolver, ValleysOfTheCapsAreMarkedWhereTheMotionComesNearThem) {
  // A bump between lines that turns by little: few nodes, between which the curvature rises and falls.
  const Contour wave = Maker()
                           .line({50, 0})
                           .bezier({{50.1, 0}, {50.3, 0}, {50.37, 0.013}, {50.6, 0}, {50.8, 0}, {51, 0}})
                           .line({99, 0})
                           .done();
  std::size_t nodes[2];
  for (const bool fast : {false, true}) {
    Progress silent;
    ProgressScope progress(silent, "bound");
    const CartesianAxisPath path(wave.path, 2);
    BoundGrid<2> grid(path, machine(2, fast ? unlimited : 10, 16000), wave.feeds(), 2e-3, progress);
    BoundSolver<2> solver(grid, progress);
    grid.build(0, path.size());
    solver.solve();
    std::vector<unsigned char> marked;
    for (int round = 0; round < 4 && solver.mark_valleys(marked) > 0; ++round) {
      grid.refine(marked);
      solver.solve_changes();
    }
    EXPECT_EQ(solver.mark_valleys(marked), 0u);
    nodes[fast] = grid.order().size();
    if (!fast) continue;
    // Between neighbours b, which is about linear in s, stays below the maximum velocity curve, but for a little.
    for (std::size_t i = 0; i + 1 < grid.order().size(); ++i) {
      const BoundNode<2>&a = grid.nodes()[i], &b = grid.nodes()[i + 1];
      if (a.segment != b.segment || !grid.cells()[i].divisible) continue;
      for (int j = 1; j < 20; ++j) {
        const PathPoint h = wave.path[a.segment].at_parameter(a.u + (b.u - a.u) * j / 20);
        const double turn = std::abs(h.d1.x * h.d2.y - h.d1.y * h.d2.x);
        const double speed =
            solver.speed_square(a.id) + (solver.speed_square(b.id) - solver.speed_square(a.id)) * j / 20;
        EXPECT_LE(speed, 16000 * (std::abs(h.d1.x) + std::abs(h.d1.y)) / turn * (1 + 3e-4)) << i;
      }
    }
  }
  EXPECT_LE(nodes[0], nodes[1]);
}

}  // namespace
}  // namespace bahnwerk::verify
