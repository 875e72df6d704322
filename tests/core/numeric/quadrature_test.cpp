#include "core/numeric/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace bahnwerk {
namespace {

TEST(GaussRule, IsExactToDegreeTwoNMinusOneAndNotBeyond) {
  for (const GaussRule* rule : {&gauss5(), &gauss7(), &gauss10()}) {
    const int n = static_cast<int>(rule->nodes.size());
    for (int degree = 0; degree < 2 * n; ++degree) {
      const double value = integrate([&](double x) { return std::pow(x, degree); }, -1, 1, *rule);
      EXPECT_NEAR(value, degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0, 1e-15) << n << " nodes, degree " << degree;
    }
    const double beyond = integrate([&](double x) { return std::pow(x, 2 * n); }, -1, 1, *rule);
    EXPECT_GT(std::abs(beyond - 2.0 / (2 * n + 1)), 1e-8);
  }
}

TEST(GaussRule, KnownNodes) {
  EXPECT_NEAR(gauss5().nodes[4], std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3, 1e-16);
  EXPECT_EQ(gauss5().nodes[2], 0);
  EXPECT_NEAR(gauss5().weights[2], 128.0 / 225, 1e-16);
}

TEST(Adaptive, MeetsItsToleranceOnDifficultIntegrands) {
  const Integral root = integrate_adaptive([](double x) { return std::sqrt(x); }, 0, 1, 1e-13);
  EXPECT_NEAR(root.value, 2.0 / 3, 1e-13);
  const Integral peak = integrate_adaptive([](double x) { return 1 / (1e-6 + x * x); }, -1, 2, 1e-13);
  EXPECT_NEAR(peak.value, 1e3 * (std::atan(1e3) + std::atan(2e3)), 1e-9);
  EXPECT_GT(peak.intervals, 10U);
  const Integral kink = integrate_adaptive([](double x) { return std::abs(x - 0.3); }, 0, 1, 1e-13);
  EXPECT_NEAR(kink.value, 0.5 * (0.09 + 0.49), 1e-13);
}

TEST(Adaptive, EndsOnANonsenseIntegrand) {
  EXPECT_TRUE(std::isnan(integrate_adaptive([](double) { return std::nan(""); }, 0, 1, 1e-12).value));
}

}  // namespace
}  // namespace bahnwerk
