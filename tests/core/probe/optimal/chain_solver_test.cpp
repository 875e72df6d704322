#include "core/probe/optimal/chain_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/probe/optimal/chain_speed.hpp"
#include "core/probe/optimal/refine.hpp"
#include "core/probe/optimal/start.hpp"

namespace bahnwerk {
namespace {

ChainLimits<2> corner() {
  ChainLimits<2> limits;
  limits.points = {{0, 0}, {4, 0}, {4, 3}};
  limits.ball = {0, 0, 0};
  limits.tolerance = 0.05;
  limits.speed = 20;
  limits.derivative = {{{200, 150}, {4000, 5000}, {200000, 180000}}};
  return limits;
}

CellChain<2> stops(const ChainLimits<2>& limits) {
  CellChain<2> chain;
  ChainNode<2> begin;
  begin.point = 0;
  begin.given = true;
  begin.state[0] = limits.points[0];
  chain.node = {begin};
  for (std::size_t e = 0; e + 1 < limits.points.size(); ++e) append_stopping_edge(chain, limits, e);
  chain.node.back().given = true;
  return chain;
}

TEST(ChainSolver, AShorterChainKeepsEveryLimit) {
  const ChainLimits<2> limits = corner();
  CellChain<2> chain = stops(limits);
  const double before = chain.duration();
  EXPECT_LE(slowing_factor(chain, limits, 0), 1);
  const ChainSolverReport report = shorten_chain(chain, limits, {1e-3, 100, 0, 1e-4}, [] {});
  EXPECT_LE(report.gap, 1e-3);
  EXPECT_LT(chain.duration(), 0.8 * before);
  EXPECT_LE(slowing_factor(chain, limits, 0), 1);
  EXPECT_EQ(chain.node.back().state[0], limits.points.back());
}

TEST(ChainSolver, FinerCellsAreTheSameMotionAndThenAQuickerOne) {
  const ChainLimits<2> limits = corner();
  CellChain<2> chain = stops(limits);
  shorten_chain(chain, limits, {1e-3, 100, 0, 1e-4}, [] {});
  CellChain<2> finer = refined(chain, limits, 1, 0);
  EXPECT_EQ(finer.cell.size(), 2 * chain.cell.size());
  EXPECT_NEAR(finer.duration(), chain.duration(), 1e-12);
  EXPECT_LE(slowing_factor(finer, limits, 0), 1);
  shorten_chain(finer, limits, {1e-3, 100, 0.02, 1e-5}, [] {});
  EXPECT_LT(finer.duration(), 0.99 * chain.duration());
}

TEST(ChainSolver, AChainThatBreaksALimitStaysAsItIs) {
  const ChainLimits<2> limits = corner();
  CellChain<2> chain = stops(limits);
  slow_down(chain, 0.2);
  const double before = chain.duration();
  EXPECT_GT(slowing_factor(chain, limits, 0), 1);
  EXPECT_EQ(shorten_chain(chain, limits, {}, [] {}).iterations, 0);
  EXPECT_EQ(chain.duration(), before);
}

TEST(ChainSolver, SlowerByAFactorIsKeptByThatFactor) {
  const ChainLimits<2> limits = corner();
  CellChain<2> chain = stops(limits);
  const double factor = slowing_factor(chain, limits, 0);
  slow_down(chain, 3);
  EXPECT_NEAR(slowing_factor(chain, limits, 0), factor / 3, 1e-12);
}

TEST(ProbeStart, DensePointsArePassedInOneGo) {
  ChainLimits<2> limits = corner();
  limits.points.clear();
  for (int i = 0; i <= 30; ++i) limits.points.push_back({8 * std::sin(0.05 * i), 8 * std::cos(0.05 * i)});
  limits.ball.assign(limits.points.size(), 0);
  const auto start = [&] {
    CellChain<2> chain;
    ChainNode<2> begin;
    begin.point = 0;
    begin.state[0] = limits.points[0];
    chain.node = {begin};
    append_start(chain, limits, 0, 30);
    return chain;
  };
  const CellChain<2> chain = start();
  EXPECT_LE(slowing_factor(chain, limits, 0), 1);
  EXPECT_LT(chain.duration(), stops(limits).duration());
  int moving = 0;
  for (const ChainNode<2>& n : chain.node) moving += std::hypot(n.state[1][0], n.state[1][1]) > 0;
  EXPECT_EQ(moving, 29);
}

}  // namespace
}  // namespace bahnwerk
