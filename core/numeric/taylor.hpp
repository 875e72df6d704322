#pragma once
/// Numbers that carry their first derivatives by one variable. A formula written once gives value and derivatives.
///
/// A Taylor<N> holds the coefficients c_0 … c_N of a truncated series Σ c_n x^n; the n-th derivative is n! c_n. Rules:
/// Griewank, Walther, "Evaluating Derivatives", 2nd ed., SIAM 2008, table 13.1 and 13.2. Cost: O(N²) per operation.
///
/// Coefficients that are discs (core/numeric/disc.hpp) enclose the derivatives everywhere in a disc of x.
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "core/numeric/sine_cosine.hpp"

namespace bahnwerk {

/// Calls f(0), …, f(count − 1) with each number known to the compiler: series are short, and loops over them that the
/// compiler vectorises take twice as long as plain code.
template <std::size_t count, class F>
[[gnu::always_inline]] inline void unrolled(F&& f) {
  [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
    (f(std::integral_constant<std::size_t, i>()), ...);
  }
  (std::make_index_sequence<count>());
}

/// A truncated series with coefficients of type S.
template <std::size_t N, class S = double>
struct Taylor {
  std::array<S, N + 1> c{};

  Taylor() = default;
  Taylor(double constant) { c[0] = constant; }  // NOLINT: constants are used in formulas like numbers
  /// Returns a series from a value and its derivatives.
  template <class... Derivatives>
  static Taylor from(double value, Derivatives... derivatives) {
    static_assert(sizeof...(Derivatives) <= N);
    Taylor t;
    t.c[0] = value;
    double factorial = 1;
    std::size_t n = 0;
    ((++n, factorial *= static_cast<double>(n), t.c[n] = derivatives / factorial), ...);
    return t;
  }
  S value() const { return c[0]; }
  S derivative(std::size_t n) const {
    double factorial = 1;
    for (std::size_t i = 2; i <= n; ++i) factorial *= static_cast<double>(i);
    return factorial * c[n];
  }

  friend Taylor operator-(const Taylor& a) {
    Taylor r;
    unrolled<N + 1>([&](auto n) __attribute__((always_inline)) { r.c[n] = -a.c[n]; });
    return r;
  }
  friend Taylor operator+(const Taylor& a, const Taylor& b) {
    Taylor r;
    unrolled<N + 1>([&](auto n) __attribute__((always_inline)) { r.c[n] = a.c[n] + b.c[n]; });
    return r;
  }
  friend Taylor operator-(const Taylor& a, const Taylor& b) {
    Taylor r;
    unrolled<N + 1>([&](auto n) __attribute__((always_inline)) { r.c[n] = a.c[n] - b.c[n]; });
    return r;
  }
  friend Taylor operator*(const Taylor& a, const Taylor& b) {
    Taylor r;
    unrolled<N + 1>([&](auto n) __attribute__((always_inline)) {
      unrolled<n + 1>([&](auto i) __attribute__((always_inline)) { r.c[n] += a.c[i] * b.c[n - i]; });
    });
    return r;
  }
  friend Taylor operator*(double a, const Taylor& b) {
    Taylor r;
    unrolled<N + 1>([&](auto n) __attribute__((always_inline)) { r.c[n] = a * b.c[n]; });
    return r;
  }
  friend Taylor operator/(const Taylor& a, const Taylor& b) {
    Taylor r;
    unrolled<N + 1>([&](auto n) __attribute__((always_inline)) {
      S rest = a.c[n];
      unrolled<n>([&](auto i) __attribute__((always_inline)) { rest -= b.c[i + 1] * r.c[n - 1 - i]; });
      r.c[n] = rest / b.c[0];
    });
    return r;
  }
  /// Undefined where the value is 0.
  friend Taylor sqrt(const Taylor& a) {
    using std::sqrt;
    Taylor r;
    r.c[0] = sqrt(a.c[0]);
    unrolled<N>([&](auto before) __attribute__((always_inline)) {
      constexpr std::size_t n = before + 1;
      S rest = a.c[n];
      unrolled<n - 1>([&](auto i) __attribute__((always_inline)) { rest -= r.c[i + 1] * r.c[n - 1 - i]; });
      r.c[n] = rest / (2 * r.c[0]);
    });
    return r;
  }
  friend SineCosine<Taylor> sine_cosine(const Taylor& a) {
    const SineCosine<S> first = sine_cosine(a.c[0]);
    SineCosine<Taylor> r;
    r.sine.c[0] = first.sine, r.cosine.c[0] = first.cosine;
    unrolled<N>([&](auto before) __attribute__((always_inline)) {
      constexpr std::size_t n = before + 1;
      unrolled<n>([&](auto j) __attribute__((always_inline)) {
        constexpr std::size_t i = j + 1;
        r.sine.c[n] += static_cast<double>(i) * a.c[i] * r.cosine.c[n - i];
        r.cosine.c[n] -= static_cast<double>(i) * a.c[i] * r.sine.c[n - i];
      });
      r.sine.c[n] /= static_cast<double>(n), r.cosine.c[n] /= static_cast<double>(n);
    });
    return r;
  }
  friend Taylor sin(const Taylor& a) { return sine_cosine(a).sine; }
  friend Taylor cos(const Taylor& a) { return sine_cosine(a).cosine; }
  /// Returns the angle of the direction (x, y); undefined where both are 0.
  friend Taylor atan2(const Taylor& y, const Taylor& x) {
    return atan2(y, x, (derived(y) * x - derived(x) * y) / (x * x + y * y));
  }
  /// Returns the angle where its derivative is known by a shorter formula.
  friend Taylor atan2(const Taylor& y, const Taylor& x, const Taylor& slope) {
    Taylor r = integral(slope);
    r.c[0] = direction_angle(y.c[0], x.c[0]);
    return r;
  }
  /// Undefined where |value| ≥ 1.
  friend Taylor acos(const Taylor& a) {
    using std::acos;
    Taylor r = integral(-(derived(a) / sqrt(Taylor(1) - a * a)));
    r.c[0] = acos(a.c[0]);
    return r;
  }

  /// Returns the derivative. Its last coefficient is unknown and not needed where integral() drops it.
  friend Taylor derived(const Taylor& a) {
    Taylor r;
    unrolled<N>([&](auto n) __attribute__((always_inline)) { r.c[n] = static_cast<double>(n + 1) * a.c[n + 1]; });
    return r;
  }

 private:
  static Taylor integral(const Taylor& a) {
    Taylor r;
    unrolled<N>([&](auto n) __attribute__((always_inline)) { r.c[n + 1] = a.c[n] / static_cast<double>(n + 1); });
    return r;
  }
};

}  // namespace bahnwerk
