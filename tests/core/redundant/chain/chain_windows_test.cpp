#include "core/redundant/chain/chain_windows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/redundant/random_chain.hpp"

namespace bahnwerk {
namespace {

/// Boxes around a slow wave: the whole and its windows have to follow the same boxes, for nearly the same energy.
Chain<2> wave(std::size_t n, double height) {
  Chain<2> chain;
  chain.steps.assign(n, 0.05);
  chain.controls.assign(n, {-1, 1});
  chain.states.resize(n + 1);
  for (std::size_t i = 0; i <= n; ++i) {
    const double x = height * (1 - std::cos(0.3 * 0.05 * static_cast<double>(i)));
    chain.states[i] = {Range{x - 1, x + 1}, Range{-4, 4}};
  }
  return chain;
}

TEST(ChainWindows, AWindowedSolutionIsOneOfTheWholeForHardlyMoreEnergy) {
  const Chain<2> chain = wave(4000, 8);
  const ChainSolution<2> whole = solve(chain, {});
  ChainWindowOptions windows;
  windows.kept = 400;
  windows.ahead = 12;
  const WindowedSolution<2> s = solve_in_windows(chain, {}, windows);
  EXPECT_TRUE(s.exceeds.empty());
  EXPECT_GT(s.energy, whole.energy * (1 - 1e-3));
  EXPECT_LT(s.energy, whole.energy * 1.01);
  for (std::size_t c = 0; c < chain.cells(); ++c) {
    const ChainState<2> next = advanced<2>(s.states[c], chain.steps[c], s.controls[c]);
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_NEAR(next[k], s.states[c + 1][k], 1e-9);
      ASSERT_LE(s.states[c][k], chain.states[c][k].highest + 1e-6);
      ASSERT_GE(s.states[c][k], chain.states[c][k].lowest - 1e-6);
    }
    ASSERT_LE(std::abs(s.controls[c]), 1 + 1e-9);
  }
  EXPECT_NEAR(s.states.front()[1], 0, 1e-12);
  EXPECT_NEAR(s.states.back()[1], 0, 1e-8);
}

/// What is smooth looks far ahead: a window that ends where a stop would fit loses a tenth.
TEST(ChainWindows, ASlowMotionIsWindowedForHardlyMoreEnergyToo) {
  Chain<2> chain = wave(6000, 8);
  for (double& step : chain.steps) step = 0.05;
  for (std::size_t i = 0; i < chain.states.size(); ++i) {
    const double x =
        8 * std::sin(0.013 * 0.05 * static_cast<double>(i) * (1 + 0.3 * std::sin(0.002 * static_cast<double>(i))));
    chain.states[i][0] = {x - 1, x + 1};
  }
  const ChainSolution<2> whole = solve(chain, {});
  ChainWindowOptions windows;
  windows.kept = 1000;
  windows.ahead = 6;
  const double own = solve_in_windows(chain, {}, windows).energy;
  windows.own_times = 0;
  const double given = solve_in_windows(chain, {}, windows).energy;
  EXPECT_LT(own, 1.01 * whole.energy);
  EXPECT_GT(given, 1.05 * whole.energy);
}

TEST(ChainWindows, OneWindowIsTheSolutionItself) {
  const Chain<2> chain = wave(300, 8);
  const ChainSolution<2> whole = solve(chain, {});
  const WindowedSolution<2> s = solve_in_windows(chain, {}, {});
  EXPECT_EQ(s.controls, whole.controls);
  EXPECT_NEAR(s.energy, whole.energy, 1e-12 * whole.energy);
}

TEST(ChainWindows, TellsWhereAChainCannotFollow) {
  Chain<2> chain = wave(2000, 8);
  for (std::size_t i = 1001; i <= 2000; ++i)  // a jump of 6 that one cell has no time for
    for (double* bound : {&chain.states[i][0].lowest, &chain.states[i][0].highest}) *bound += 6;
  ChainWindowOptions windows;
  windows.kept = 300;
  windows.followed = 1e-7;
  const WindowedSolution<2> s = solve_in_windows(chain, {}, windows);
  ASSERT_FALSE(s.exceeds.empty());
  EXPECT_LE(s.exceeds.front().first, 1001u);
  EXPECT_GE(s.exceeds.back().second, 1000u);
}

TEST(ChainWindows, AGivenStateAtTheBeginIsKept) {
  Chain<2> chain = wave(300, 8);
  chain.begin = ChainState<2>{0.3, 0.5};
  chain.ends_at_rest = false;
  const ChainSolution<2> s = solve(chain, {});
  EXPECT_EQ(s.states.front(), *chain.begin);
  EXPECT_LE(s.excess, 0);
}

TEST(ChainWindows, AnAxisThatCanStandStillDoes) {
  Chain<2> chain = test::point_to_point<2>(0, 10, 100);
  for (auto& boxes : chain.states) boxes[0] = {-1, 2};
  chain.states[50][0] = {0.5, 3};
  const WindowedSolution<2> still = solve_in_windows(chain, ChainOptions(), ChainWindowOptions());
  EXPECT_EQ(still.energy, 0);
  EXPECT_TRUE(still.exceeds.empty());
  for (const auto& x : still.states) {
    EXPECT_EQ(x[0], 1.25);
    EXPECT_EQ(x[1], 0);
  }
  chain.controls[20] = {0.1, 0.2};  // it has to move
  EXPECT_GT(solve_in_windows(chain, ChainOptions(), ChainWindowOptions()).energy, 0);
}

}  // namespace
}  // namespace bahnwerk
