#include "core/numeric/linear/integrator_chain.hpp"

#include <gtest/gtest.h>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

TEST(IntegratorChain, AdvancesAsThePolynomialDoes) {
  const ChainState<2> a = advanced<2>({1, 2}, 0.5, 4);
  EXPECT_DOUBLE_EQ(a[0], 1 + 2 * 0.5 + 0.5 * 4 * 0.25);
  EXPECT_DOUBLE_EQ(a[1], 2 + 4 * 0.5);
  const ChainState<3> b = advanced<3>({1, 2, 3}, 0.5, 6);
  EXPECT_DOUBLE_EQ(b[0], 1 + 2 * 0.5 + 1.5 * 0.25 + 0.125);
  EXPECT_DOUBLE_EQ(b[1], 2 + 3 * 0.5 + 3 * 0.25);
  EXPECT_DOUBLE_EQ(b[2], 3 + 6 * 0.5);
}

template <std::size_t order>
void adjoint(Random& random) {
  ChainState<order> x, g;
  for (std::size_t k = 0; k < order; ++k) {
    x[k] = random.uniform(-1, 1);
    g[k] = random.uniform(-1, 1);
  }
  const double h = random.uniform(0.01, 2), u = random.uniform(-1, 1);
  const ChainState<order> y = advanced<order>(x, h, u), back = pulled_back<order>(g, h);
  double left = 0, right = by_control<order>(g, h) * u;
  for (std::size_t k = 0; k < order; ++k) {
    left += g[k] * y[k];
    right += back[k] * x[k];
  }
  EXPECT_NEAR(left, right, 1e-14);
}

TEST(IntegratorChain, GradientsArePulledBackByTheTransposedMap) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    adjoint<2>(random);
    adjoint<3>(random);
  }
}

}  // namespace
}  // namespace bahnwerk
