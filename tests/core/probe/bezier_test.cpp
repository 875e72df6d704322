#include "core/probe/bezier.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk::probe {
namespace {

Vec at(const std::array<Vec, 8>& c, double t) {
  Vec x;
  for (std::size_t i = c.size(); i-- > 0;) x = c[i] + t * x;
  return x;
}

TEST(ProbeBezier, PeaksEncloseWhatSamplesFind) {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    std::array<Vec, 8> c;
    for (Vec& v : c) v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double T = random.uniform(0.5, 2);
    const Bezier piece = bezier(c.data(), c.size(), T);
    double sampled = 0;
    for (int k = 0; k <= 2000; ++k) sampled = std::max(sampled, norm(at(c, T * k / 2000)));
    const double peak = peak_of(
        piece, [](Vec x) { return norm(x); }, 0, 1e-10);
    EXPECT_GE(peak, sampled * (1 - 1e-13));
    EXPECT_LE(peak, sampled * (1 + 1e-5));
  }
}

TEST(ProbeBezier, DerivativesAreThoseOfThePolynomial) {
  const std::array<Vec, 4> c{Vec{1, 0, 0}, {2, 1, 0}, {0, -3, 1}, {1, 0, 2}};
  const Bezier v = derivative(bezier(c.data(), 4, 0.7), 0.7);
  EXPECT_NEAR(norm(v.b[0] - c[1]), 0, 1e-14);
  EXPECT_NEAR(norm(v.b[v.n - 1] - (c[1] + 1.4 * c[2] + 3 * 0.49 * c[3])), 0, 1e-13);
}

TEST(ProbeBezier, NothingAboveTheFloorGivesTheFloor) {
  const std::array<Vec, 2> c{Vec{1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(peak_of(
                bezier(c.data(), 2, 1), [](Vec x) { return norm(x); }, 5.0),
            5);
}

}  // namespace
}  // namespace bahnwerk::probe
