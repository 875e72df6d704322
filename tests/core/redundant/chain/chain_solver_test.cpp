#include "core/redundant/chain/chain_solver.hpp"

#include <gtest/gtest.h>

#include "tests/core/redundant/random_chain.hpp"

namespace bahnwerk {
namespace {

using test::known_chain;
using test::point_to_point;

/// A lower bound of what any motion costs that exceeds the boxes of its states at a price of `penalty`: Lagrange
/// function with the multipliers of the solution, ½ h a² replaced by its tangent, least over controls in their boxes.
template <std::size_t order>
double dual_bound(const Chain<order>& chain, const ChainSolution<order>& s) {
  const std::size_t n = chain.cells();
  const auto least = [](double g, const Range& r) { return g > 0 ? g * r.lowest : g * r.highest; };
  ChainState<order> costate{};
  for (std::size_t k = 1; k < order; ++k) costate[k] = s.at_end[k];
  double value = 0;
  for (std::size_t i = n + 1; i-- > 0;) {
    if (i < n) {
      double g = by_control<order>(costate, chain.steps[i]);
      if (order == 2) {
        g += chain.steps[i] * s.controls[i];
        value -= 0.5 * chain.steps[i] * s.controls[i] * s.controls[i];
      }
      value += least(g, chain.controls[i]);
      costate = pulled_back<order>(costate, chain.steps[i]);
    }
    for (std::size_t k = 0; k < order; ++k) {
      if (!chain.counts(i, k)) continue;
      const double z = s.multipliers[i][k];
      costate[k] += z;
      value -= z > 0 ? z * chain.states[i][k].highest : z * chain.states[i][k].lowest;
    }
    if constexpr (order == 3) {
      const double w = 0.5 * ((i > 0 ? chain.steps[i - 1] : 0) + (i < n ? chain.steps[i] : 0)), a = s.states[i][2];
      costate[2] += w * a;
      value -= 0.5 * w * a * a;
    }
  }
  return value + least(costate[0], chain.states[0][0]);
}

template <std::size_t order>
void known_problems(std::uint64_t seed, int count) {
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    const auto known = known_chain<order>(random, 10 + 2 * random.below(60));
    ChainOptions options;
    options.gap = 1e-6;
    const ChainSolution<order> s = solve(known.chain, options);
    ASSERT_TRUE(s.converged);
    EXPECT_LE(s.excess, 0);
    EXPECT_LE(test::excess(known.chain, s.states, s.controls), 1e-9);
    for (std::size_t k = 1; k < order; ++k) {
      EXPECT_EQ(s.states.front()[k], 0);
      EXPECT_NEAR(s.states.back()[k], 0, 1e-9);
    }
    for (std::size_t c = 0; c < known.chain.cells(); ++c)
      for (std::size_t k = 0; k < order; ++k)
        EXPECT_EQ(s.states[c + 1][k], advanced<order>(s.states[c], known.chain.steps[c], s.controls[c])[k]);
    EXPECT_NEAR(s.energy, test::energy<order>(known.chain, s.states, s.controls), 1e-12 * (1 + s.energy));
    EXPECT_LE(s.energy, known.energy * (1 + 1e-5) + 1e-5);
    EXPECT_NEAR(dual_bound(known.chain, s), 0.5 * s.energy, 1e-4 * (1 + s.energy));
  }
}

TEST(ChainSolver, FindsTheOptimumOfProblemsThatHaveASolution) { known_problems<2>(3, 100); }
TEST(ChainSolver, FindsItWithLimitedJerk) { known_problems<3>(4, 60); }

TEST(ChainSolver, LeastEnergyFromRestToRestIsThatOfTheCubic) {
  for (const double time : {3.0, 5.0, 10.0}) {  // ∫a² = 12 way²/time³, in n cells 1/(1 − 1/n²) of it
    const Chain<2> chain = point_to_point<2>(1, time, 100);
    ChainOptions options;
    options.gap = 1e-8;
    const ChainSolution<2> s = solve(chain, options);
    EXPECT_NEAR(s.energy, 12 / (time * time * time) / (1 - 1e-4), 1e-4 * s.energy);
  }
}

TEST(ChainSolver, TheShortestTimeDecidesWhetherThereIsASolution) {
  // Order 2: way = time²/4; order 3: way = time³/32.
  const std::size_t cells = 64;
  EXPECT_LE(solve(point_to_point<2>(0.999, 2, cells), {}).excess, 0);
  EXPECT_GT(solve(point_to_point<2>(1.001, 2, cells), {}).excess, 1e-5);
  EXPECT_LE(solve(point_to_point<3>(0.999, std::cbrt(32.0), cells), {}).excess, 0);
  EXPECT_GT(solve(point_to_point<3>(1.001, std::cbrt(32.0), cells), {}).excess, 1e-5);
}

TEST(ChainSolver, WithoutRestAtTheEndsItStandsStillWhereItCan) {
  Chain<2> chain = point_to_point<2>(0, 1, 10);
  chain.begins_at_rest = chain.ends_at_rest = false;
  for (auto& x : chain.states) x[0] = {-1, 1};
  EXPECT_NEAR(solve(chain, {}).energy, 0, 1e-3);
  // From −1 to 1 in 1 s at constant velocity, which from rest would need energy.
  chain.states.front()[0] = {-1, -0.999};
  chain.states.back()[0] = {0.999, 1};
  const ChainSolution<2> s = solve(chain, {});
  EXPECT_LE(s.excess, 0);
  EXPECT_NEAR(s.energy, 0, 1e-3);
  EXPECT_NEAR(s.states[5][1], 2, 2e-2);
}

TEST(ChainSolver, FixedControlsAreKept) {
  Chain<2> chain = point_to_point<2>(0.5, 2, 40);
  for (std::size_t c = 0; c < 5; ++c) {
    chain.controls[c] = {1, 1};
    chain.controls[39 - c] = {-1, -1};
  }
  const ChainSolution<2> s = solve(chain, {});
  EXPECT_LE(s.excess, 0);
  for (std::size_t c = 0; c < 5; ++c) {
    EXPECT_EQ(s.controls[c], 1);
    EXPECT_EQ(s.controls[39 - c], -1);
  }
  EXPECT_NEAR(s.states.back()[1], 0, 1e-12);
}

TEST(ChainSolver, EveryIterationAsksWhetherToGoOn) {
  struct Enough {};
  ChainOptions options;
  options.tick = [n = 0]() mutable {
    if (++n == 3) throw Enough{};
  };
  EXPECT_THROW(solve(point_to_point<2>(0.5, 2, 40), options), Enough);
}

}  // namespace
}  // namespace bahnwerk
