#include "core/redundant/chain/chain_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

template <std::size_t order>
Chain<order> chain(Random& random, std::size_t n) {
  Chain<order> c;
  for (std::size_t i = 0; i < n; ++i) c.steps.push_back(random.uniform(0.2, 1));
  c.states.resize(n + 1), c.controls.resize(n);
  return c;
}

/// The gradient of the objective at the step, pulled back to every control, is that of a motion whose derivatives at
/// the end are held by the multipliers.
template <std::size_t order>
void expect_stationary(Random& random) {
  constexpr std::size_t n = 8;
  const Chain<order> c = chain<order>(random, n);
  ChainStep<order> newton(c);
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t k = 0; k < order; ++k) {
      newton.weight[i][k] = random.uniform(0.1, 2);
      newton.gradient[i][k] = random.uniform(-1, 1);
    }
  for (std::size_t i = 0; i < n; ++i) {
    newton.cell_weight[i] = i == 3 ? 0 : random.uniform(0.1, 2);
    newton.cell_gradient[i] = i == 3 ? 0 : random.uniform(-1, 1);
  }
  newton.factorise();
  for (int again = 0; again < 2; ++again) {  // one factorisation, two right-hand sides
    ChainState<order> end{};
    for (std::size_t k = 0; k < order; ++k) end[k] = random.uniform(-1, 1);
    newton.gradient[4][0] = random.uniform(-1, 1);
    newton.solve(end);
    for (std::size_t k = 1; k < order; ++k) EXPECT_NEAR(end[k] + newton.d_states[n][k], 0, 1e-9);
    EXPECT_EQ(newton.d_controls[3], 0) << "its weight of 0 fixes it";
    ChainState<order> pull{};
    for (std::size_t k = 1; k < order; ++k) pull[k] = newton.at_end()[k];
    for (std::size_t i = n + 1; i-- > 0;) {
      for (std::size_t k = 0; k < order; ++k)
        pull[k] += newton.weight[i][k] * newton.d_states[i][k] + newton.gradient[i][k];
      if (i == 0) break;
      const double control = by_control<order>(pull, c.steps[i - 1]) +
                             newton.cell_weight[i - 1] * newton.d_controls[i - 1] + newton.cell_gradient[i - 1];
      if (i - 1 != 3) {
        EXPECT_NEAR(control, 0, 1e-9) << i - 1;
      }
      pull = pulled_back<order>(pull, c.steps[i - 1]);
    }
    EXPECT_NEAR(pull[0], 0, 1e-9) << "the place at the begin is free";
  }
}

TEST(ChainStep, StepsAreStationaryAndEndAtRest) {
  Random random(41);
  for (int i = 0; i < 20; ++i) expect_stationary<2>(random), expect_stationary<3>(random);
}

/// Where the end is free the recursion's own step counts.
TEST(ChainStep, AFreeEndHasNoMultipliers) {
  Random random(42);
  Chain<2> c = chain<2>(random, 5);
  c.ends_at_rest = false;
  ChainStep<2> newton(c);
  for (auto& w : newton.weight) w = {1, 1};
  for (double& w : newton.cell_weight) w = 1;
  newton.gradient[5] = {0, 1};
  newton.factorise();
  newton.solve({0, 3});
  EXPECT_EQ(newton.at_end()[1], 0);
  EXPECT_LT(newton.d_states[5][1], 0);
}

}  // namespace
}  // namespace bahnwerk
