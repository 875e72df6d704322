#include "core/probe/optimal/refine.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/probe/optimal/chain_problem.hpp"
#include "core/probe/optimal/chain_speed.hpp"
#include "tests/core/probe/optimal/chains.hpp"

namespace bahnwerk {
namespace {

using test::corner, test::stops;

TEST(Refine, FinerCellsAreTheSameMotionAndThenAQuickerOne) {
  const ChainLimits<2> limits = corner();
  CellChain<2> chain = stops(limits);
  shorten_chain(chain, limits, 1e-4, {1e-3, 100});
  CellChain<2> finer = refined(chain, limits, 1, 0);
  EXPECT_EQ(finer.cell.size(), 2 * chain.cell.size());
  EXPECT_NEAR(finer.duration(), chain.duration(), 1e-12);
  EXPECT_LE(slowing_factor(finer, limits, 0), 1);
  shorten_chain(finer, limits, 1e-5, {1e-3, 100, 0.02});
  EXPECT_LT(finer.duration(), 0.99 * chain.duration());
}

}  // namespace
}  // namespace bahnwerk
