#include "core/numeric/linear/riccati.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

std::vector<double> durations(Random& random, std::size_t n) {
  std::vector<double> steps;
  for (std::size_t c = 0; c < n; ++c) steps.push_back(random.uniform(0.2, 1));
  return steps;
}

/// The gradient of the objective at the step, pulled back to every free number, is 0: that of a motion whose
/// derivatives at the end are held by the multipliers. The problem is convex, so this is its solution.
template <std::size_t order>
void expect_stationary(Random& random, bool from_rest, bool to_rest) {
  constexpr std::size_t n = 8, fixed = 3;
  const std::vector<double> steps = durations(random, n);
  const std::size_t free = from_rest ? 1 : order;
  Riccati<order> newton(steps, free, to_rest);
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t k = 0; k < order; ++k) {
      newton.weight[i][k] = random.uniform(0.1, 2);
      newton.gradient[i][k] = random.uniform(-1, 1);
    }
  for (std::size_t c = 0; c < n; ++c) {
    newton.cell_weight[c] = c == fixed ? 0 : random.uniform(0.1, 2);
    newton.cell_gradient[c] = c == fixed ? 0 : random.uniform(-1, 1);
  }
  newton.factor();
  for (int again = 0; again < 2; ++again) {  // one factorisation, two right-hand sides
    ChainState<order> end{};
    for (std::size_t k = 0; k < order; ++k) end[k] = random.uniform(-1, 1);
    newton.gradient[4][0] = random.uniform(-1, 1);
    newton.solve(end);
    ChainState<order> x = newton.d_states[0], pull{};
    for (std::size_t k = free; k < order; ++k) EXPECT_EQ(x[k], 0);
    for (std::size_t c = 0; c < n; ++c) {
      x = advanced<order>(x, steps[c], newton.d_controls[c]);
      for (std::size_t k = 0; k < order; ++k) EXPECT_NEAR(x[k], newton.d_states[c + 1][k], 1e-9);
    }
    EXPECT_EQ(newton.d_controls[fixed], 0) << "its weight of 0 fixes it";
    for (std::size_t k = 1; k < order; ++k) {
      pull[k] = newton.at_end()[k];
      if (to_rest) {
        EXPECT_NEAR(end[k] + newton.d_states[n][k], 0, 1e-9);
      } else {
        EXPECT_EQ(pull[k], 0) << "a free end has no multipliers";
      }
    }
    for (std::size_t i = n + 1; i-- > 0;) {
      for (std::size_t k = 0; k < order; ++k)
        pull[k] += newton.weight[i][k] * newton.d_states[i][k] + newton.gradient[i][k];
      if (i == 0) break;
      const std::size_t c = i - 1;
      const double control = by_control<order>(pull, steps[c]) + newton.cell_weight[c] * newton.d_controls[c];
      if (c != fixed) {
        EXPECT_NEAR(control + newton.cell_gradient[c], 0, 1e-9) << c;
      }
      pull = pulled_back<order>(pull, steps[c]);
    }
    for (std::size_t k = 0; k < free; ++k) EXPECT_NEAR(pull[k], 0, 1e-9) << k;
  }
}

TEST(Riccati, StepsAreStationaryWhereverTheEndsAreFree) {
  Random random(41);
  for (int i = 0; i < 40; ++i)
    for (const bool to_rest : {false, true}) {
      expect_stationary<2>(random, i % 2 == 0, to_rest);
      expect_stationary<3>(random, i % 2 == 0, to_rest);
    }
}

}  // namespace
}  // namespace bahnwerk
