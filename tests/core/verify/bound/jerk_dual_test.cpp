// Weak duality: whatever the multipliers, what they prove is less than the time of a motion that holds all limits.
#include "core/verify/bound/jerk_dual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/base/progress.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/verify/bound/bound_solver.hpp"
#include "core/verify/bound/jerk_ways.hpp"
#include "core/verify/bound/one_way.hpp"
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

// What jerk leaves of the axes' accelerations around the nodes, in the place of A; `quickest`: speeds at which it
// counts.
int limit(Laid& laid, BoundGrid<2>& grid, double quickest, ProgressScope& progress) {
  BoundSolver<2> solver(grid, progress);
  solver.solve();
  OneWay<2> one_way;
  const std::vector<double> b = solver.speed_squares(grid.order().size());
  one_way.take(grid, b, true, true, machine().cycle_time);
  const auto nodes = grid.nodes();
  std::vector<JerkWays<2>> ways;
  std::size_t piece = 0;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    if (nodes[i].segment != nodes[i + 1].segment) continue;
    JerkCapPiece<2> p;
    one_way.set(p, nodes[i], nodes[i + 1], i, i);
    ways.emplace_back().add(laid.pieces[piece++],
                            {p.ahead[0].steps + p.ahead[0].end, p.ahead[1].steps + p.ahead[1].end},
                            {p.behind[0].steps + p.behind[0].end, p.behind[1].steps + p.behind[1].end}, quickest);
  }
  int limited = 0;
  for (std::size_t i = 0; i <= ways.size(); ++i) {
    laid.problem.limits.push_back(jerk_limit(ways[i > 0 ? i - 1 : 0], ways[i < ways.size() ? i : i - 1], grid));
    for (const auto& sides : laid.problem.limits.back().root) limited += (sides[0] > 0) + (sides[1] > 0);
  }
  return limited;
}

constexpr double corner_angle = 0.03;

/// What a motion takes, s.
double planned(const Contour& contour) {
  SilentProgress silent;
  JerkLimitedOptions options;
  options.corner_angle = corner_angle;
  return plan_jerk_limited(contour, machine(), options, silent).law.duration();
}

TEST(JerkDual, NoMultipliersProveMoreThanAMotionTakesUnderAccelerationLimitsFromJerk) {
  const std::vector<Contour> contours{
      Maker().line({20, 0}).arc({30, 10}, {20, 10}, true).line({30, 30}).done(),
      Maker().line({10, 0}).arc({20, 10}, {10, 10}, true).arc({10, 20}, {10, 10}, true).done(),
      Maker().bezier({{30, 40}, {60, -40}, {80, 20}}).done(),
      Maker().arc({5, 5}, {0, 5}, true).arc({-1, 11}, {-1, 5}, true).arc({-8, 4}, {-1, 4}, true).done(),
  };
  SilentProgress silent;
  ProgressScope progress(silent, "test", 0, 1);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> part(0, 1), sign(-1, 1);
  for (const Contour& contour : contours) {
    const CartesianAxisPath path(contour.path, 2);
    const double time = planned(contour);
    BoundGrid<2> grid(path, machine(), contour.feeds(), corner_angle, progress);
    grid.build(0, path.size());
    for (int i = 0; i < 2; ++i) grid.refine(std::vector<unsigned char>(grid.order().size() - 1, 1));
    Laid laid = lay(grid, true);
    EXPECT_GT(limit(laid, grid, 10, progress), 50);
    RelaxationSolver<2> solver;
    EXPECT_TRUE(solver.solve(laid.problem, {}, progress).converged);
    const RelaxationMultipliers<2> best = solver.multipliers();
    JerkDual<2> dual(grid, progress);
    const auto value = [&](const RelaxationMultipliers<2>& m) {
      return dual.value(laid.pieces, 0, laid.pieces.size(), laid.cell_of, laid.problem, m);
    };
    EXPECT_LE(value(best), time);
    EXPECT_GE(value(best), 0.4 * time);
    for (int i = 0; i < 200; ++i) {
      // Any part of the multipliers, at either side; any tangent; any part of them against either limit.
      RelaxationMultipliers<2> m = best;
      for (std::size_t n = 0; n < m.acceleration.size(); ++n)
        for (std::size_t k = 0; k < 2; ++k) {
          if (i % 3 == 0) m.acceleration[n][k] *= 1.5 * part(random);
          if (i % 2 == 0) m.acceleration[n][k] += sign(random) * 1e-9;
          if (i % 5 < 2) m.limited[n][k] = part(random);
        }
      if (i % 7 < 3)
        for (double& b : m.b) b *= std::exp(sign(random));
      EXPECT_LE(value(m), time) << i;
    }
    // The multipliers of a problem with too little acceleration ask for more than these limits give.
    for (const double factor : {0.9, 0.8, 0.6, 0.4}) {
      RelaxationProblem<2> slower = laid.problem;
      for (auto& around : slower.limits)
        for (auto& sides : around.root)
          for (double& root : sides) root *= factor;
      solver.solve(slower, {}, progress);
      for (const double at : {1.0, 0.3, 0.1}) {
        RelaxationMultipliers<2> m = solver.multipliers();
        for (double& b : m.b) b *= at;
        EXPECT_LE(value(m), time) << factor << ' ' << at;
        for (auto& row : m.limited) row = {1, 1};
        EXPECT_LE(value(m), time) << factor << ' ' << at;
      }
    }
  }
}

TEST(JerkDual, NoMultipliersProveMoreThanAMotionTakes) {
  const std::vector<Contour> contours{
      Maker().line({20, 0}).arc({30, 10}, {20, 10}, true).line({30, 30}).done(),
      Maker().bezier({{30, 40}, {60, -40}, {80, 20}}).done(),
      Maker().bezier({{3, 1}, {4, 4}}).bezier({{8, 16}, {5, 9}, {9, 9}}).done(),
      Maker().line({10, 0}).line({20, 0.1}).line({30, 0}).done(),
      Maker().arc({5, 5}, {0, 5}, true).arc({-1, 11}, {-1, 5}, true).arc({-8, 4}, {-1, 4}, true).done(),
  };
  SilentProgress silent;
  ProgressScope progress(silent, "test", 0, 1);
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
  SilentProgress silent;
  ProgressScope progress(silent, "test", 0, 1);
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
