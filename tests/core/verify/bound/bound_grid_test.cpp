// What the proof of the lower bound asks of its grid: every axis moves one way only in a cell, energies are never too
// small and ways never too long, and every cap lets pass what is feasible.
#include "core/verify/bound/bound_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "tests/core/motion/axes/five_axes.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk::verify {
namespace {

using reference::machine;
using reference::Maker;

template <int N = 2>
struct Grid {
  explicit Grid(const Contour& contour, const Machine& m = machine(N, 500, 16000), double corner_angle = 2e-3)
      : path(contour.path, N), progress(silent, "bound"), grid(path, m, contour.feeds(), corner_angle, progress) {
    grid.build(0, contour.path.size());
  }
  CartesianAxisPath path;
  Progress silent;
  ProgressScope progress;
  BoundGrid<N> grid;
};

template <int N>
Vec point(const std::array<double, N>& v) {
  return {v[0], v[1], N == 3 ? v[2] : 0};
}

template <int N>
void expect_sound(const Contour& contour, const BoundGrid<N>& grid) {
  double length = 0;
  for (std::size_t i = 0; i < grid.cells().size(); ++i) {
    const BoundNode<N>&a = grid.nodes()[i], &b = grid.nodes()[i + 1];
    const BoundCell<N>& cell = grid.cells()[i];
    if (cell.kind == BoundCell<N>::Kind::joint) {
      EXPECT_EQ(a.segment + 1, b.segment);
      continue;
    }
    length += cell.length;
    EXPECT_GT(b.u, a.u);
    EXPECT_LE(angle_between(point<N>(a.tangent), point<N>(b.tangent)), 0.02 + 1e-12);
    for (std::size_t k = 0; k < grid.axes(); ++k) {
      EXPECT_GE(a.tangent[k] * b.tangent[k], 0) << i << " axis " << k;
      double way = 0;  // ∫|h'_k| ds as the length of a fine polyline's shadow
      Vec last = point<N>(a.position);
      for (int j = 1; j <= 20; ++j) {
        const Vec here = contour.path[a.segment].at_parameter(a.u + (b.u - a.u) * j / 20).value;
        way += std::abs(here[k] - last[k]);
        last = here;
      }
      const double rounding = 1e-13 * (1 + norm(point<N>(a.position)) + cell.length);
      EXPECT_GE(cell.energy[k], 2 * grid.acceleration(k) * (way - rounding)) << i << " axis " << k;
      EXPECT_LE(cell.energy[k], 2 * grid.acceleration(k) * (way + 20 * rounding)) << i << " axis " << k;
      EXPECT_LE(cell.displacement[k], way + rounding);
      EXPECT_GE(cell.displacement[k], way - 20 * rounding);
    }
  }
  EXPECT_NEAR(length, contour.path.length(), 1e-10 * contour.path.length());
  EXPECT_EQ(grid.nodes().front().cap, 0);
  EXPECT_EQ(grid.nodes().back().cap, 0);
}

TEST(BoundGrid, EveryAxisMovesOneWayInEveryCell) {
  for (unsigned i = 0; i < 30; ++i) {
    std::mt19937_64 random(40 + i);
    const Contour contour = reference::random_contour(random, 6, i % 2);
    Grid<2> g(contour);
    expect_sound(contour, g.grid);
    std::vector<unsigned char> all(g.grid.cells().size(), 1);
    g.grid.refine(all);
    expect_sound(contour, g.grid);
  }
}

TEST(BoundGrid, HelixAndSpaceCurves) {
  const Contour contour = Maker(3, {10, 0, 0})
                              .arc({0, 10, 3}, {0, 0, 0}, true)
                              .arc({10, 0, 12}, {0, 0, 3}, true)
                              .bezier({{20, 0, 30}, {30, 20, 10}, {0, 0, 0}})
                              .done();
  Grid<3> g(contour, machine(3, 500, 9000));
  expect_sound(contour, g.grid);
}

TEST(BoundGrid, ANodeStandsWhereAnAxisTurnsBack) {
  const Contour circle = reference::circle_between_lines();
  Grid<2> g(circle);
  int turns = 0;
  for (const BoundNode<2>& n : g.grid.nodes())
    if (n.segment == 1 && (n.tangent[0] == 0 || n.tangent[1] == 0)) {
      ++turns;
      // There the other axis cannot speed up along the path: b ≤ A r.
      EXPECT_LE(n.cap, 16000 * 10 * (1 + 1e-9));
    }
  EXPECT_GE(turns, 3);
}

TEST(BoundGrid, TwoTurnsBetweenCoarseNodesAreSeen) {
  // y rises, dips a little and rises again within 0.003 rad of turning.
  const Contour wave = Maker().bezier({{30, 0.011, 0}, {70, -0.001, 0}, {100, 0.01, 0}}).done();
  Grid<2> g(wave);
  int turns = 0;
  for (const BoundNode<2>& n : g.grid.nodes()) turns += n.tangent[1] == 0;
  EXPECT_EQ(turns, 2);
  expect_sound(wave, g.grid);
}

TEST(BoundGrid, CornersRestAndSmallJumpsAreCapped) {
  const double angle = 1e-3;
  const Contour q2 = Maker()
                         .line({40, 0})
                         .line({40 + 40 * std::cos(angle), 40 * std::sin(angle)})
                         .line({40 + 40 * std::cos(angle), 80})
                         .done();
  Grid<2> g(q2, machine(2, 1e5, 16000, 1e-5));
  EXPECT_NEAR(std::sqrt(g.grid.nodes()[1].cap), 0.16 / std::sin(angle), 1e-6);
  EXPECT_EQ(g.grid.nodes()[3].cap, 0);
  EXPECT_EQ(g.grid.nodes()[4].cap, 0);
}

// What is known of a cell holds in its parts.
TEST(BoundGrid, RememberedEnclosuresHoldInPartsOfTheCell) {
  const test::FiveAxes kinematics;
  const Contour contour = Maker().bezier({{30, 40}, {60, -40}, {80, 20}}).done();
  const KinematicAxisPath path(contour.path, kinematics);
  Progress silent;
  ProgressScope progress(silent, "bound");
  BoundGrid<5> grid(path, {kinematics.axes(), 0.001}, contour.feeds(), 2e-3, progress);
  grid.build(0, path.size());
  std::size_t looked = 0;
  for (std::size_t i = 0; i + 1 < grid.nodes().size(); ++i) {
    const BoundNode<5>&a = grid.nodes()[i], &b = grid.nodes()[i + 1];
    if (a.segment != b.segment || !(b.s - a.s > 1e-3)) continue;
    const BoundNode<5> from = grid.node(a.segment, a.u + 0.3 * (b.u - a.u)),
                       to = grid.node(a.segment, a.u + 0.6 * (b.u - a.u));
    const DirectionRange<5> whole = grid.range(a, b);
    grid.remember(a, b);
    const DirectionRange<5> range = grid.range(from, to);
    const std::array<double, 5> third = grid.third(from, to);
    grid.forget();
    for (int j = 0; j <= 10; ++j) {
      const BoundNode<5> n = grid.node(a.segment, from.u + (to.u - from.u) * j / 10),
                         next = grid.node(a.segment, n.u + 1e-4 * (b.u - a.u));
      for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_GE(n.tangent[k], range.low[k] - 1e-12);
        EXPECT_LE(n.tangent[k], range.high[k] + 1e-12);
        EXPECT_LE(std::abs(next.curvature[k] - n.curvature[k]), third[k] * (next.s - n.s) * (1 + 1e-6) + 1e-11);
        EXPECT_LE(range.high[k] - range.low[k], whole.high[k] - whole.low[k] + 1e-12);
      }
    }
    ++looked;
  }
  EXPECT_GT(looked, 20u);
}

}  // namespace
}  // namespace bahnwerk::verify
