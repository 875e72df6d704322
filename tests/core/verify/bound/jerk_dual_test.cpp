// Weak duality: whatever the multipliers, what they prove is less than the time of a motion that holds all limits.
#include "core/verify/bound/jerk_dual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/base/progress.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/verify/bound/bound_solver.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk::verify {
namespace {

using reference::Maker;

constexpr double V = 600, A = 16000, J = 1e6;

Machine machine() {
  Machine m = reference::machine(2, V, A);
  for (AxisLimits& axis : m.axes) axis.jerk = J;
  return m;
}

/// One piece per cell of the bound's grid, and the relaxation over them. Nothing is known of speed but that both axes
/// together reach no more than √2 V. At joints either nothing is known of the steps of acceleration but their size, or,
/// with `known`, that part of them which follows from q″.
struct Laid {
  Blocks<DualPiece<2>> pieces;
  std::vector<std::size_t> cell_of;
  RelaxationProblem<2> problem;
};

Laid lay(const BoundGrid<2>& grid, bool known) {
  Laid laid;
  laid.problem.acceleration = {A, A}, laid.problem.jerk = {J, J};
  DualJoint<2> joint;
  const auto nodes = grid.nodes();
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const auto &a = nodes[i], &b = nodes[i + 1];
    if (a.segment != b.segment) {
      joint.here = true, joint.cap = 2 * V * V;
      for (std::size_t k = 0; k < 2; ++k) {
        joint.tangent_jump[k] = b.tangent[k] - a.tangent[k];
        // Where an axis' q' jumps v̇ is at most what the other one leaves along the path.
        joint.step[k] = known ? std::min(J * 0.001, std::abs(joint.tangent_jump[k]) * 2 * A) : J * 0.001;
        if (known) joint.acceleration_step[k] = b.curvature[k] - a.curvature[k];
      }
      continue;
    }
    DualPiece<2> p = dual_piece(grid, a, b, 2 * V * V, grid.third(a, b));
    p.joint = joint;
    joint = {};
    RelaxationCell<2> cell{p.length, p.displacement, p.begin, p.end, p.cap};
    if (p.joint.here)
      laid.problem.steps.push_back({laid.problem.cells.size(),
                                    0,
                                    {p.joint.step[0] / J, p.joint.step[1] / J},
                                    p.joint.tangent_jump,
                                    p.joint.acceleration_step});
    laid.cell_of.push_back(laid.problem.cells.size());
    laid.problem.cells.push_back(cell);
    laid.pieces.push_back(p);
  }
  return laid;
}

constexpr double corner_angle = 0.03;

/// What a motion takes, s.
double planned(const Contour& contour) {
  Progress silent;
  JerkLimitedOptions options;
  options.corner_angle = corner_angle;
  return plan_jerk_limited(contour, machine(), options, silent).law.duration();
}

TEST(JerkDual, NoMultipliersProveMoreThanAMotionTakes) {
  const std::vector<Contour> contours{
      Maker().line({20, 0}).arc({30, 10}, {20, 10}, true).line({30, 30}).done(),
      Maker().bezier({{30, 40}, {60, -40}, {80, 20}}).done(),
      Maker().bezier({{3, 1}, {4, 4}}).bezier({{8, 16}, {5, 9}, {9, 9}}).done(),
      Maker().line({10, 0}).line({20, 0.1}).line({30, 0}).done(),
      Maker().arc({5, 5}, {0, 5}, true).arc({-1, 11}, {-1, 5}, true).arc({-8, 4}, {-1, 4}, true).done(),
  };
  Progress silent;
  ProgressScope progress(silent, "test");
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(0, 1.5), sign(-1, 1);
  for (const Contour& contour : contours) {
    const CartesianAxisPath path(contour.path, 2);
    const double time = planned(contour);
    BoundGrid<2> grid(path, machine(), contour.feeds(), corner_angle, progress);
    grid.build(0, path.size());
    for (const bool known : {false, true}) {
      const Laid laid = lay(grid, known);
      RelaxationSolver<2> solver;
      solver.solve(laid.problem, {}, progress);
      const RelaxationMultipliers<2> best = solver.multipliers();
      JerkDual<2> dual(grid, progress);
      const auto value = [&](const RelaxationMultipliers<2>& m) {
        return dual.value(laid.pieces, 0, laid.pieces.size(), laid.cell_of, laid.problem, m);
      };
      EXPECT_LE(value(best), time);
      EXPECT_GE(value(best), 0.4 * time);
      for (int i = 0; i < 200; ++i) {
        // All scaled, single ones scaled, noise added; then no more jerk than is allowed.
        RelaxationMultipliers<2> m = best;
        const double all = i % 3 == 0 ? part(random) : 1, noise = i % 2 == 0 ? 0.1 * part(random) : 0;
        for (auto& row : m.jerk) {
          for (double& l : row) l = l * all * (i % 5 == 0 ? part(random) : 1) + noise * sign(random) / J;
          const double load = J * (std::abs(row[0]) + std::abs(row[1]));
          if (load > 1) row[0] /= load, row[1] /= load;
        }
        for (auto& row : m.acceleration)
          for (double& l : row) l = l * all * (i % 7 == 0 ? part(random) : 1) + noise * sign(random) * 1e-9;
        EXPECT_LE(value(m), time) << i << ' ' << known;
      }
    }
  }
}

TEST(JerkDual, IsTheTimeAtTheLargestSpeedWithoutMultipliers) {
  const Contour contour = Maker().line({30, 40}).done();
  const CartesianAxisPath path(contour.path, 2);
  Progress silent;
  ProgressScope progress(silent, "test");
  BoundGrid<2> grid(path, machine(), contour.feeds(), 1e-3, progress);
  grid.build(0, path.size());
  const Laid laid = lay(grid, true);
  RelaxationMultipliers<2> none;
  none.jerk.resize(laid.problem.cells.size() + 2), none.acceleration.resize(laid.problem.cells.size() + 1);
  JerkDual<2> dual(grid, progress);
  EXPECT_NEAR(dual.value(laid.pieces, 0, laid.pieces.size(), laid.cell_of, laid.problem, none),
              50 / std::sqrt(2 * V * V), 1e-12);
}

}  // namespace
}  // namespace bahnwerk::verify
