// Numerators and denominators of a path's curves against the derivatives of the quotient.
#include "core/motion/interpolation/piece_series.hpp"

#include <gtest/gtest.h>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "tests/core/motion/interpolation/moved.hpp"

namespace bahnwerk {
namespace {

TEST(PieceSeries, TheQuotientHasTheCurvesDerivatives) {
  const auto polynomial = std::make_shared<const Rational>(
      Rational::from_power_basis({{1000, 2, -3, 4, 1}, {-500, 1, 1, -2, 3}, {0, 0, 2, 1, -1}}));
  const auto path = test::path_of({test::quintic(), polynomial, test::quarter_ellipse(7, 3),
                                   std::make_shared<const Line>(Vec{1, 2, 3}, Vec{4, 4, 9}),
                                   std::make_shared<const Arc>(Vec{}, Vec{1, 0, 0}, Vec{0, 1, 0}, 8, 2.0, 5)});
  const PieceSeries series(*path);
  for (std::size_t i = 0; i < path->size(); ++i)
    for (int k = 0; k <= 20; ++k) {
      const Curve& curve = (*path)[i].curve();
      const double u = curve.begin() + k / 20.0 * (curve.end() - curve.begin());
      const QuotientJet jet = series.at(i, u);
      const Jet given = curve.at(u);
      EXPECT_LE(norm(jet.d1() - given.d1), 1e-12 * (1 + norm(given.d1))) << i;
      EXPECT_LE(norm(jet.d2() - given.d2), 1e-11 * (1 + norm(given.d2))) << i;
    }
}

TEST(PieceSeries, DenominatorsAreThoseOfTheCurve) {
  const auto path = test::path_of({test::quarter_ellipse(7, 3)});
  const PieceSeries series(*path);
  // N = (1 − u)² + √2 u (1 − u) + u², up to a factor.
  const auto n = [](double u) { return (1 - u) * (1 - u) + std::sqrt(2) * u * (1 - u) + u * u; };
  const double factor = series.at(0, 0).n0;
  for (const double u : {0.0, 0.2, 0.7, 1.0}) {
    const QuotientJet jet = series.at(0, u);
    EXPECT_NEAR(jet.n0, factor * n(u), 1e-14 * factor);
    EXPECT_NEAR(jet.n1, factor * (std::sqrt(2) - 2) * (1 - 2 * u), 1e-13 * factor);
    EXPECT_NEAR(jet.n2, factor * (4 - 2 * std::sqrt(2)), 1e-13 * factor);
  }
}

}  // namespace
}  // namespace bahnwerk
