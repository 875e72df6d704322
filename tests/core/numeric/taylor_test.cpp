// Against finite differences and closed forms.
#include "core/numeric/taylor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace bahnwerk {
namespace {

using T = Taylor<3>;

/// Derivatives of f(x(t)) at t = 0 by central differences of high order, against those that Taylor carries.
template <class F>
void compare(F&& f, double x0, double d1, double d2, double d3) {
  const T result = f(T::from(x0, d1, d2, d3));
  const auto at = [&](double t) { return f(T(x0 + t * (d1 + t * (d2 / 2 + t * d3 / 6)))).value(); };
  const double h = 1e-2;
  const auto difference = [&](double step) {
    return std::array{(at(step) - at(-step)) / (2 * step), (at(step) - 2 * at(0) + at(-step)) / (step * step),
                      (at(2 * step) - 2 * at(step) + 2 * at(-step) - at(-2 * step)) / (2 * step * step * step)};
  };
  const auto coarse = difference(h), fine = difference(h / 2);
  EXPECT_DOUBLE_EQ(result.value(), at(0));
  for (std::size_t n = 1; n <= 3; ++n) {
    const double expected = (4 * fine[n - 1] - coarse[n - 1]) / 3;  // Richardson
    EXPECT_NEAR(result.derivative(n), expected, 2e-5 * (1 + std::abs(expected))) << "derivative " << n;
  }
}

TEST(Taylor, FollowsFormulas) {
  for (const double x : {-0.7, 0.2, 0.6}) {
    compare([](const T& a) { return a * a * a - T(2) * a; }, x, 1.3, -0.4, 0.8);
    compare([](const T& a) { return (T(1) + a) / (T(2) - a * a); }, x, 0.7, 0.5, -0.9);
    compare([](const T& a) { return sqrt(T(3) + a); }, x, -1.1, 0.3, 0.4);
    compare([](const T& a) { return sin(a) * cos(T(2) * a); }, x, 0.9, -0.6, 0.2);
    compare([](const T& a) { return atan2(T(1) + a, a * a - T(0.3)); }, x, 0.8, 0.1, -0.5);
    compare([](const T& a) { return acos(T(0.8) * a); }, x, 0.5, 0.3, 0.6);
    compare(  // on the unit circle, whose angle has the derivative y′/x
        [](const T& a) {
          return atan2(T(0.8) * a, sqrt(T(1) - T(0.64) * a * a), T(0.8) * derived(a) / sqrt(T(1) - T(0.64) * a * a));
        },
        x, 0.5, 0.3, 0.6);
    compare(
        [](const T& a) {
          const auto both = sine_cosine(a);
          return both.sine / both.cosine;
        },
        x, 0.4, 0.3, 0.2);
  }
}

TEST(Taylor, IsExactForTheIdentity) {
  const T x = T::from(0.5, 1.0), one = sin(x) * sin(x) + cos(x) * cos(x);
  EXPECT_NEAR(one.value(), 1, 1e-15);
  for (std::size_t n = 1; n <= 3; ++n) EXPECT_NEAR(one.derivative(n), 0, 1e-15);
  const T round = sqrt(x * x);
  EXPECT_NEAR(round.derivative(1), 1, 1e-15);
  EXPECT_NEAR(round.derivative(2), 0, 1e-15);
}

}  // namespace
}  // namespace bahnwerk
