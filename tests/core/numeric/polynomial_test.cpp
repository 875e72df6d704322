#include "core/numeric/polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

Polynomial some(Random& random, std::size_t size) {
  Polynomial p(size);
  for (double& c : p) c = random.normal();
  return p;
}

TEST(Polynomial, RingOperationsAgreeWithValues) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Polynomial p = some(random, random.below(8)), q = some(random, random.below(8));
    const double x = random.uniform(-2, 2), a = evaluate(p, x), b = evaluate(q, x);
    EXPECT_NEAR(evaluate(p + q, x), a + b, 1e-10);
    EXPECT_NEAR(evaluate(p - q, x), a - b, 1e-10);
    EXPECT_NEAR(evaluate(p * q, x), a * b, 1e-9);
    EXPECT_NEAR(evaluate(2.5 * p, x), 2.5 * a, 1e-10);
  }
}

TEST(Polynomial, DerivativeAndDeflation) {
  EXPECT_EQ(derivative({5, 1, 2, 3}), (Polynomial{1, 4, 9}));
  EXPECT_EQ(derivative({}), Polynomial{});
  EXPECT_EQ(deflated({0, 0, 7, 8}, 2), (Polynomial{7, 8}));
  EXPECT_EQ(deflated({1}, 3), Polynomial{});
}

TEST(Polynomial, ShiftIsSubstitution) {
  EXPECT_EQ(shifted({0, 0, 1}, 1, 1), (Polynomial{1, 2, 1}));
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Polynomial p = some(random, 1 + random.below(9));
    const double at = random.uniform(-1, 1), scale = random.uniform(-1, 1), y = random.uniform(-1, 1);
    EXPECT_NEAR(evaluate(shifted(p, at, scale), y), evaluate(p, at + scale * y), 1e-11);
  }
}

TEST(Polynomial, BernsteinAgreesWithDeCasteljau) {
  Random random(3);
  for (std::size_t n = 0; n <= 16; ++n) {
    const std::vector<double> b = some(random, n + 1);
    const Polynomial p = from_bernstein(b);
    for (double t = -1; t <= 1; t += 0.125) {
      std::vector<long double> row(b.begin(), b.end());
      const long double u = (1 + static_cast<long double>(t)) / 2;
      for (std::size_t left = n; left > 0; --left)
        for (std::size_t i = 0; i < left; ++i) row[i] = (1 - u) * row[i] + u * row[i + 1];
      EXPECT_NEAR(evaluate(p, t), static_cast<double>(row[0]), 1e-15 * std::pow(2.5, static_cast<double>(n)) + 1e-15);
    }
  }
}

}  // namespace
}  // namespace bahnwerk
