#pragma once
/// Polynomials that a piece of a motion gains for it to end in a given state.
#include <array>

namespace bahnwerk::probe {

/// Returns the coefficients of τ⁴ … τ⁷ of the polynomial that vanishes with three derivatives at τ = 0 and has value x,
/// first, second and third derivative v, a, j at τ = h > 0, s. `T` is a number or a vector.
template <typename T>
std::array<T, 4> landing(const T& x, const T& v, const T& a, const T& j, double h) {
  const T v1 = h * v, a1 = (h * h) * a, j1 = (h * h * h) * j;
  const double h4 = h * h * h * h;
  return {(1 / h4) * (35 * x - 15 * v1 + 2.5 * a1 - (1.0 / 6) * j1),
          (1 / (h4 * h)) * (-84 * x + 39 * v1 - 7 * a1 + 0.5 * j1),
          (1 / (h4 * h * h)) * (70 * x - 34 * v1 + 6.5 * a1 - 0.5 * j1),
          (1 / (h4 * h * h * h)) * (-20 * x + 10 * v1 - 2 * a1 + (1.0 / 6) * j1)};
}

/// Returns the coefficients of τ⁴ … τ⁶ of the polynomial of degree 6 with derivatives v, a, j at τ = h, whose value
/// there is free.
template <typename T>
std::array<T, 3> landing(const T& v, const T& a, const T& j, double h) {
  const T v1 = h * v, a1 = (h * h) * a, j1 = (h * h * h) * j;
  const double h4 = h * h * h * h;
  return {(1 / h4) * (2.5 * v1 - a1 + 0.125 * j1), (1 / (h4 * h)) * (-3 * v1 + 1.4 * a1 - 0.2 * j1),
          (1 / (h4 * h * h)) * (v1 - 0.5 * a1 + (1.0 / 12) * j1)};
}

}  // namespace bahnwerk::probe
