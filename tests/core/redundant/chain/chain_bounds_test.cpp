#include "core/redundant/chain/chain_bounds.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

ChainBound started(double limit, double x, double penalty) {
  ChainBound b;
  b.limit = limit;
  b.start(x, penalty);
  return b;
}

TEST(ChainBounds, BeginBalancedInsideAndOutsideOfTheBox) {
  for (const double x : {-50.0, 0.9, 1.0, 1.1, 50.0}) {
    const ChainBound b = started(1, x, 1e4);
    EXPECT_GT(b.slack, 0) << x;
    EXPECT_GT(b.excess, 0) << x;
    EXPECT_GT(b.z, 0) << x;
    EXPECT_GT(b.below, 0) << x;
    EXPECT_DOUBLE_EQ(b.z + b.below, 1e4) << x;
    EXPECT_NEAR(x + b.slack - b.excess, 1, 1e-13) << x;
  }
  const ChainBound hard = started(1, 1.5, ChainBound::hard);
  EXPECT_EQ(hard.slack, 0.1);
  EXPECT_EQ(hard.excess, 0);
}

/// A full step satisfies the bound's own equation, and its products differ from their targets by the products of the
/// steps alone.
TEST(ChainBounds, AStepSolvesTheLinearEquations) {
  for (const double penalty : {1e4, ChainBound::hard}) {
    const double x = 0.7, dx = 0.05;
    ChainBound b = started(1, x, penalty);
    b.aim_at_zero(penalty);
    b.weigh(penalty);
    b.direct(x + dx, penalty);
    const double slack = b.slack, z = b.z, excess = b.excess, below = b.below;
    EXPECT_NEAR(slack * b.dz + z * b.d_slack, -slack * z, 1e-12);
    ChainProducts products;
    products.add(b, penalty);
    if (penalty < ChainBound::hard) {
      EXPECT_NEAR(-excess * b.dz + below * b.d_excess, -excess * below, 1e-9);
      EXPECT_NEAR(products.linear, -slack * z - excess * below, 1e-9);
    } else {
      EXPECT_NEAR(products.linear, -slack * z, 1e-12);
    }
    b.advance(1, penalty);
    EXPECT_NEAR(x + dx + b.slack - b.excess, 1, 1e-12);
    EXPECT_NEAR(b.slack * b.z + (penalty < ChainBound::hard ? b.excess * b.below : 0), products.square, 1e-9);
  }
}

}  // namespace
}  // namespace bahnwerk
