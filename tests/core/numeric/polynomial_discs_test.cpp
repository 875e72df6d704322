// A polynomial and its derivatives all over a disc, against its values there.
#include "core/numeric/polynomial_discs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace bahnwerk {
namespace {

using Complex = std::complex<double>;

TEST(PolynomialDiscs, EncloseDerivativesOverTheDisc) {
  const Polynomial p{0.3, -1.2, 0.5, 2.1, -0.7, 0.4};
  for (const double at : {-0.8, 0.0, 0.6})
    for (const double radius : {0.0, 1e-3, 0.2, 0.9}) {
      const Taylor<3, Disc> all = enclose(p, at, radius);
      for (int j = 0; j < 64; ++j) {
        const Complex x = at + std::polar(radius * (j % 2 ? 1 : 0.6), 2 * M_PI * j / 64);
        double factorial = 1;
        Polynomial d = p;
        for (std::size_t n = 0; n <= 3; ++n) {
          Complex value = 0;
          for (std::size_t k = d.size(); k-- > 0;) value = value * x + d[k];
          EXPECT_LE(std::abs(value / factorial - all.c[n].centre), all.c[n].radius + 1e-16) << n;
          factorial *= static_cast<double>(n + 1), d = derivative(d);
        }
      }
      if (radius == 0) {
        EXPECT_LE(all.c[3].radius, 1e-12);
      }
    }
  EXPECT_TRUE(enclose({}, 0.5, 1).c[0].zero());
}

}  // namespace
}  // namespace bahnwerk
