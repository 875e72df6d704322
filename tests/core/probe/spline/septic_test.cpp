#include "core/probe/spline/septic.hpp"

#include <gtest/gtest.h>

#include "core/numeric/random.hpp"

namespace bahnwerk::probe {
namespace {

Vec any(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Σ c_i tⁱ and its first three derivatives.
SepticEnd at(const std::array<Vec, 8>& c, double t) {
  SepticEnd s;
  for (std::size_t i = 8; i-- > 0;) {
    s.j = t * s.j + 3 * s.a;
    s.a = t * s.a + 2 * s.v;
    s.v = t * s.v + s.x;
    s.x = t * s.x + c[i];
  }
  return s;
}

TEST(Septic, BothFormsHaveTheStatesAtBothEndsAndAreOneCurve) {
  Random random(8);
  for (int i = 0; i < 50; ++i) {
    const double h = random.uniform(0.1, 2);
    const SepticEnd left{any(random, 10), any(random, 10), any(random, 20), any(random, 40)},
        right{any(random, 10), any(random, 10), any(random, 20), any(random, 40)};
    const auto c = septic_coefficients(left, right, h);
    const SepticEnd begin = at(c, 0), end = at(c, h);
    EXPECT_EQ(begin.x, left.x);
    EXPECT_EQ(begin.v, left.v);
    EXPECT_LE(norm(begin.a - left.a) + norm(begin.j - left.j), 1e-12);
    EXPECT_LE(norm(end.x - right.x), 1e-10);
    EXPECT_LE(norm(end.v - right.v), 1e-9);
    EXPECT_LE(norm(end.a - right.a), 1e-7 / h);
    EXPECT_LE(norm(end.j - right.j), 1e-6 / (h * h));
    const Bezier b = septic(left, right, h), same = bezier(c.data(), c.size(), h);
    ASSERT_EQ(b.n, 8u);
    for (std::size_t k = 0; k < b.n; ++k) EXPECT_LE(norm(b.b[k] - same.b[k]), 1e-10) << k;
  }
}

TEST(Septic, APolynomialOfDegreeSevenIsReproduced) {
  Random random(3);
  std::array<Vec, 8> c;
  for (Vec& v : c) v = any(random, 5);
  const double h = 0.7;
  const auto found = septic_coefficients(at(c, 0), at(c, h), h);
  for (std::size_t i = 0; i < c.size(); ++i) EXPECT_LE(norm(found[i] - c[i]), 1e-8) << i;
}

}  // namespace
}  // namespace bahnwerk::probe
