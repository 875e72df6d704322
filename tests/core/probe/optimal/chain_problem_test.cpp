#include "core/probe/optimal/chain_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/probe/optimal/chain_speed.hpp"
#include "tests/core/probe/optimal/chains.hpp"

namespace bahnwerk {
namespace {

using test::corner, test::stops;

TEST(ChainProblem, AShorterChainKeepsEveryLimit) {
  const ChainLimits<2> limits = corner();
  CellChain<2> chain = stops(limits);
  const double before = chain.duration();
  EXPECT_LE(slowing_factor(chain, limits, 0), 1);
  const FeasibleResult report = shorten_chain(chain, limits, 1e-4, {1e-3, 100});
  EXPECT_LE(report.gap, 1e-3);
  EXPECT_LT(chain.duration(), 0.8 * before);
  EXPECT_LE(slowing_factor(chain, limits, 0), 1);
  EXPECT_EQ(chain.node.back().state[0], limits.points.back());
}

TEST(ChainProblem, AChainThatBreaksALimitStaysAsItIs) {
  const ChainLimits<2> limits = corner();
  CellChain<2> chain = stops(limits);
  slow_down(chain, 0.2);
  const double before = chain.duration();
  EXPECT_GT(slowing_factor(chain, limits, 0), 1);
  EXPECT_EQ(shorten_chain(chain, limits, 1e-4, {}).iterations, 0);
  EXPECT_EQ(chain.duration(), before);
}

}  // namespace
}  // namespace bahnwerk
