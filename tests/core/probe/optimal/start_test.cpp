#include "core/probe/optimal/start.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/probe/optimal/chain_speed.hpp"
#include "tests/core/probe/optimal/chains.hpp"

namespace bahnwerk {
namespace {

using test::corner, test::stops;

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
