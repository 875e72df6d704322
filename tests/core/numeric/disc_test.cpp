// Enclosures against what the same formula gives at random places of the discs.
#include "core/numeric/disc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "core/numeric/taylor.hpp"

namespace bahnwerk {
namespace {

using Complex = std::complex<double>;

// What std::complex does not have.
Complex direction_angle(Complex y, Complex x) {
  return Complex(0, -0.5) * std::log((x + Complex(0, 1) * y) / (x - Complex(0, 1) * y));
}

/// f of two discs holds what it gives for places of them, and is no wider than `slack` times what was found.
template <class F>
void expect_enclosed(F&& f, double x0, double y0, double radius, double slack) {
  const Disc enclosed = f(Disc(x0, radius), Disc(y0, 0.7 * radius));
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  double off = 0;
  for (int round = 0; round < 2000; ++round) {
    const double size = round % 2 ? 1 : std::sqrt(uniform(random));
    const Complex x = x0 + std::polar(radius * size, 2 * M_PI * uniform(random)),
                  y = y0 + std::polar(0.7 * radius * size, 2 * M_PI * uniform(random));
    off = std::max(off, std::abs(f(x, y) - enclosed.centre));
  }
  EXPECT_LE(off, enclosed.radius);
  EXPECT_LE(enclosed.radius, slack * off + 1e-15);
}

TEST(Disc, EnclosesWhatFormulasGive) {
  for (const double radius : {1e-6, 0.02, 0.2}) {
    expect_enclosed([](auto x, auto y) { return x * y - x + y; }, 0.4, -0.7, radius, 2.5);
    expect_enclosed([](auto x, auto y) { return (x + y) / (y * y); }, 0.4, -1.7, radius, 4);
    expect_enclosed([](auto x, auto y) { return sqrt(x + y); }, 0.4, 1.5, radius, 1.1);
    expect_enclosed([](auto x, auto y) { return sin(x) * cos(y); }, 0.4, 2.1, radius, 2);
    expect_enclosed([](auto x, auto y) { return direction_angle(y, x); }, 1.1, 0.8, radius, 2);
    expect_enclosed([](auto x, auto y) { return acos(x * y); }, 0.4, 0.8, radius, 2.5);
  }
  expect_enclosed([](auto x, auto) { return sin(x); }, 0.4, 0, 1.7, 1.5);
  const SineCosine<Disc> both = sine_cosine(Disc(0.4, 0.3));
  EXPECT_EQ(both.sine.radius, sin(Disc(0.4, 0.3)).radius);
  EXPECT_EQ(both.cosine.radius, cos(Disc(0.4, 0.3)).radius);
  expect_enclosed([](auto x, auto) { return cos(x); }, 0.4, 0, 1.7, 1.5);
}

TEST(Disc, KnowsNothingWhereASingularityMayBeReached) {
  const Disc near(0.3, 0.4), zero(0);
  EXPECT_FALSE((Disc(1) / near).known());
  EXPECT_FALSE(sqrt(near).known());
  EXPECT_FALSE(acos(near + Disc(0.5)).known());
  EXPECT_FALSE(direction_angle(near, near).known());
  EXPECT_FALSE((Disc(1) / near * zero).known());
  EXPECT_TRUE(sqrt(near + Disc(0.2)).known());
}

TEST(Disc, NumbersStayThemselvesButForRounding) {
  const Disc third = Disc(1) / Disc(3), one = third + third + third;
  EXPECT_LE(std::abs(one.centre - 1), one.radius);
  EXPECT_LE(one.radius, 1e-14);
  EXPECT_TRUE((Disc(0) * Disc(7)).zero());
}

TEST(Disc, EnclosesDerivativesAsCoefficientOfASeries) {
  using T = Taylor<3>;
  using Wide = Taylor<3, Disc>;
  const auto formula = [](const auto& x) {
    using X = std::decay_t<decltype(x)>;
    return atan2(sin(x), X(2) + x * x) + sqrt(X(3) + x) / (X(2) + cos(x));
  };
  const double at = 0.7, radius = 0.01;
  Wide x;
  x.c[0] = Disc(at, radius), x.c[1] = 1;
  const Wide all = formula(x);
  for (int i = -20; i <= 20; ++i) {
    const T here = formula(T::from(at + radius * i / 20, 1.0));
    for (std::size_t n = 0; n <= 3; ++n) {
      EXPECT_LE(std::abs(here.derivative(n) - all.derivative(n).centre), all.derivative(n).radius) << n;
      EXPECT_LE(all.derivative(n).radius, 0.2) << n;
    }
  }
}

}  // namespace
}  // namespace bahnwerk
