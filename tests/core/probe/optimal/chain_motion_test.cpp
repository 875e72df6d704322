#include "core/probe/optimal/chain_motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/motion/axes/spline_motion.hpp"
#include "tests/core/probe/optimal/chains.hpp"

namespace bahnwerk {
namespace {

TEST(ChainMotion, PiecesPassTheNodesWithTheirStatesAndEndAtRest) {
  const ChainLimits<2> limits = test::corner();
  const CellChain<2> chain = test::stops(limits);
  std::vector<SplineMotion::Piece> pieces;
  std::vector<double> times;
  append_pieces<2>(
      chain,
      [](const std::array<Polynomial, 2>& x) {
        return std::vector<Polynomial>{x[0], x[1]};
      },
      pieces, times);
  ASSERT_EQ(pieces.size(), CellBasis::pieces * chain.cell.size());
  ASSERT_EQ(times.size(), 2u) << "the corner and the end";
  EXPECT_NEAR(times[1], chain.duration(), 1e-14);
  const SplineMotion motion(pieces);
  double t = 0;
  for (std::size_t c = 0; c < chain.cell.size(); ++c) {
    t += chain.cell[c].duration;
    const MotionState x = motion.in_piece(CellBasis::pieces * (c + 1) - 1, t);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& state = chain.node[c + 1].state;
      EXPECT_NEAR(x[0][k], state[0][k], 1e-10) << c;
      EXPECT_NEAR(x[1][k], state[1][k], 1e-11) << c;
      EXPECT_NEAR(x[2][k], state[2][k], 1e-9) << c;
      EXPECT_NEAR(x[3][k], state[3][k], 1e-7) << c;
    }
  }
  const MotionState corner = motion.evaluate(times[0]);
  EXPECT_NEAR(corner[0][0], 4, 1e-12);
  EXPECT_NEAR(corner[0][1], 0, 1e-12);
}

TEST(ChainMotion, WhatRoundingLeavesOpenIsPutIntoHigherDegrees) {
  Polynomial p = quartic({1, 2, 3, 4}, 5);
  EXPECT_DOUBLE_EQ(p[4], 5.0 / 24);
  const double T = 0.5;
  land(p, T, {0, 4.5, 6, 6.5});
  const auto end = state_at(p, T);
  EXPECT_NEAR(end[1], 4.5, 1e-13);
  EXPECT_NEAR(end[2], 6, 1e-12);
  EXPECT_NEAR(end[3], 6.5, 1e-11);
}

}  // namespace
}  // namespace bahnwerk
