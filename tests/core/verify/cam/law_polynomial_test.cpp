#include "core/verify/cam/law_polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace bahnwerk::verify {
namespace {

TEST(LawPolynomial, SumsAndDerivativesOfACube) {
  const std::vector<double> cube{0, 0, 0, 8};  // (2x)³ over [0, 1], 2 s long: t³
  EXPECT_NEAR(bernstein_sum(cube, 0.25), 0.125, 1e-15);
  EXPECT_NEAR(bernstein_sum(cube, 1), 8, 1e-15);
  EXPECT_NEAR(bernstein_sum(derivative_coefficients(cube, 2, 1), 0.75), 3 * 1.5 * 1.5, 1e-14);
  EXPECT_EQ(derivative_coefficients(cube, 2, 3), std::vector<double>{6});
  EXPECT_EQ(derivative_coefficients(cube, 2, 4), std::vector<double>{0});
}

TEST(LawPolynomial, TheEnclosedMaximumIsNeverBelowSamples) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int i = 0; i < 100; ++i) {
    std::vector<double> c(1 + random() % 22);
    for (double& each : c) each = value(random);
    const auto found = enclosed_maximum(c, 1e-12);
    double sampled = -2;
    for (int k = 0; k <= 1000; ++k) sampled = std::max(sampled, bernstein_sum(c, k / 1000.0));
    EXPECT_GE(found.value, sampled - 1e-14);
    EXPECT_NEAR(bernstein_sum(c, found.at), found.value, 1e-10);
  }
}

TEST(LawPolynomial, TheMeanSquareIsTheIntegral) {
  const std::vector<double> c{1, -2, 0.5, 3};
  double sum = 0;
  constexpr int steps = 2000;
  for (int k = 0; k < steps; ++k) sum += std::pow(bernstein_sum(c, (k + 0.5) / steps), 2) / steps;
  EXPECT_NEAR(mean_square(c), sum, 1e-5);
  EXPECT_NEAR(mean_square({0, 1}), 1.0 / 3, 1e-15);
}

}  // namespace
}  // namespace bahnwerk::verify
