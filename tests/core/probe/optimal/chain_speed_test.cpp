#include "core/probe/optimal/chain_speed.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/probe/optimal/chains.hpp"

namespace bahnwerk {
namespace {

using test::corner, test::stops;

TEST(ChainSpeed, SlowerByAFactorIsKeptByThatFactor) {
  const ChainLimits<2> limits = corner();
  CellChain<2> chain = stops(limits);
  const double factor = slowing_factor(chain, limits, 0);
  slow_down(chain, 3);
  EXPECT_NEAR(slowing_factor(chain, limits, 0), factor / 3, 1e-12);
}

}  // namespace
}  // namespace bahnwerk
