#include "core/geometry/path/second_derivative_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {
namespace {

TEST(BendBoundTest, HoldsAndTightens) {
  const Rational curves[] = {Rational::bezier({{100, 0, 0}, {101, 3, 1}, {104, -2, 0}, {105, 1, 2}}),
                             Rational::bezier({{100, 0, 0}, {101, 3, 1}, {104, -2, 0}, {105, 1, 2}}, {1, 3, 0.5, 2})};
  for (const Rational& curve : curves) {
    const SecondDerivativeBound bound(curve);
    for (double width = 1; width > 1e-3; width *= 0.5) {
      double most = 0;
      for (int i = 0; i <= 50; ++i) most = std::max(most, norm(curve.at(0.4 + width * (i / 50.0 - 0.4)).d2));
      const double b = bound.at(0.4 - 0.4 * width, 0.4 + 0.6 * width);
      EXPECT_GE(b, most * (1 - 1e-9));
      if (width < 0.01) {
        EXPECT_LE(b, 1.5 * most + 1);
      }
    }
  }
}

}  // namespace
}  // namespace bahnwerk
