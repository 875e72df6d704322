// Ways of axes in one direction, on contours where they are known.
#include "core/verify/bound/one_way.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/progress.hpp"
#include "core/verify/bound/bound_solver.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk::verify {
namespace {

using reference::Maker;

/// Ways at every cell of the contour's grid.
struct Ways {
  std::vector<BoundNode<2>> nodes;
  std::vector<JerkCapPiece<2>> pieces;
};

Ways ways(const Contour& contour, double jerk, bool rest_last = true) {
  Machine m = reference::machine(2, 600, 16000);
  for (AxisLimits& axis : m.axes) axis.jerk = jerk;
  Progress silent;
  ProgressScope progress(silent, "test");
  const CartesianAxisPath path(contour.path, 2);
  BoundGrid<2> grid(path, m, contour.feeds(), 0.03, progress);
  grid.build(0, path.size(), true, rest_last);
  BoundSolver<2> solver(grid, progress);
  solver.solve();
  OneWay<2> one_way;
  one_way.take(grid, solver.speed_squares(grid.order().size()), true, rest_last, m.cycle_time);
  Ways all;
  const auto nodes = grid.nodes();
  for (std::size_t i = 0; i + 1 < grid.order().size(); ++i) {
    all.nodes.push_back(nodes[i]);
    one_way.set(all.pieces.emplace_back(), nodes[i], nodes[i + 1], i, i);
  }
  return all;
}

TEST(OneWay, EndsWhereAnAxisTurnsRound) {
  // Half a circle about (10, 10) from (10, 0) to (10, 20): x turns round at 20, y stands at its end.
  const Ways all = ways(Maker().line({10, 0}).arc({10, 20}, {10, 10}, true).done(), 1e6);
  for (std::size_t i = 0; i < all.pieces.size(); ++i) {
    const auto& p = all.pieces[i];
    const auto& a = all.nodes[i];
    const bool arc = a.segment == 1, back = arc && a.position[1] > 10;
    if (!arc) continue;
    const auto& b = all.nodes[std::min(i + 1, all.nodes.size() - 1)];
    if (a.position[1] < 0.1 || a.position[1] > 19.9) continue;
    EXPECT_NEAR(p.ahead[1].displacement, 20 - b.position[1], 0.01) << i;
    if (std::abs(a.position[1] - 10) < 0.5) continue;  // next to the turn
    const double x = b.position[0];
    if (back)
      EXPECT_NEAR(p.behind[0].displacement, 20 - a.position[0], 0.01) << i;
    else
      EXPECT_NEAR(p.ahead[0].displacement, 20 - x, 0.01) << i;
    EXPECT_LE(back ? p.behind[0].displacement : p.ahead[0].displacement, 20 - (back ? a.position[0] : x) + 1e-9);
  }
}

TEST(OneWay, AddsTheStepsAtJointsAndEndsAtOpenEnds) {
  const Contour contour = Maker().line({10, 0}).arc({20, 10}, {10, 10}, true).line({20, 30}).done();
  const double cycle = reference::machine(2, 600, 16000).cycle_time;
  const auto on_arc = [](const Ways& ways) {
    std::size_t i = 0;
    while (ways.nodes[i].position[1] < 5) ++i;
    return i;
  };
  const Ways all = ways(contour, 1e5);
  const JerkCapPiece<2>& p = all.pieces[on_arc(all)];
  EXPECT_FALSE(std::isfinite(p.ahead[1].displacement));  // to the rest at its end
  EXPECT_FALSE(std::isfinite(p.behind[0].displacement));
  EXPECT_NEAR(p.behind[1].steps, 0, 1e-9);  // the arc's own: y sets out there
  EXPECT_NEAR(p.behind[0].steps, 0, 1e-5 * 16000 + 1e-9);
  EXPECT_NEAR(p.ahead[1].steps, 0, 1e-5 * 16000 + 1e-9);
  const Ways open = ways(contour, 1e5, false);
  EXPECT_NEAR(open.pieces[on_arc(open)].ahead[1].displacement, 30 - open.nodes[on_arc(open) + 1].position[1], 1e-9);

  // At 45° both axes step at the joint of a line and an arc: by what the cycle allows, or not at all.
  const double r = 10 / std::sqrt(2.0);
  const Contour diagonal = Maker().line({r, r}).arc({3 * r, r}, {2 * r, 0}, false).done();
  const Ways smooth = ways(diagonal, 1e5), steep = ways(diagonal, 1e9);
  EXPECT_FALSE(std::isfinite(smooth.pieces.front().ahead[0].displacement));
  EXPECT_GE(smooth.pieces.front().ahead[0].steps, 1e5 * cycle);
  EXPECT_LE(smooth.pieces.front().ahead[0].steps, 1e5 * cycle + 1e-5 * 16000 + 1e-3);
  EXPECT_LE(steep.pieces.front().ahead[0].displacement, r);
}

TEST(OneWay, EndsAtANodeWhereAnAxisTurnsAndKnowsItsAccelerationThere) {
  // Two quarters of about a circle of radius 10: at their joint x turns round, with x' = 0 exactly and no kink.
  const double k = 5.522847498307936;
  const Contour contour = Maker()
                              .line({10, 0})
                              .bezier({{10 + k, 0}, {20, 10 - k}, {20, 10}})
                              .bezier({{20, 10 + k}, {10 + k, 20}, {10, 20}})
                              .done();
  const Ways all = ways(contour, 1e6);
  const double fastest = 16000 * 10 * std::sqrt(2.0);  // b, of both axes
  int before = 0, behind = 0;
  for (std::size_t i = 0; i + 1 < all.pieces.size(); ++i) {
    const auto &a = all.nodes[i], &b = all.nodes[i + 1];
    const bool first = a.segment == 1 && b.segment == 1 && b.position[1] < 9.5,
               second = a.segment == 2 && a.position[1] > 10.5;
    if (!first && !second) continue;
    const AxisWay& way = first ? all.pieces[i].ahead[0] : all.pieces[i].behind[0];
    EXPECT_LE(way.displacement, 20 - (first ? b : a).position[0] + 1e-9) << i;
    EXPECT_GE(way.displacement, 20 - (first ? b : a).position[0] - 0.01) << i;
    EXPECT_LE(way.end, 1.01 * fastest / 10) << i;
    ++(first ? before : behind);
  }
  EXPECT_GT(before, 10);
  EXPECT_GT(behind, 10);
  // At rest nothing accelerates.
  EXPECT_EQ(all.pieces.front().behind[0].end, 0);
}

TEST(OneWay, KinksEndIt) {
  const Ways all = ways(Maker().line({10, 0}).line({20, 0.1}).line({30, 0}).done(), 1e6);
  EXPECT_NEAR(all.pieces.front().ahead[0].displacement, 0, 1e-9);
}

}  // namespace
}  // namespace bahnwerk::verify
