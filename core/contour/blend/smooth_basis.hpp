#pragma once
/// Values and three derivatives of the six B-splines of degree 5 that do not vanish at a place.
#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry/curve/bspline_basis.hpp"

namespace bahnwerk::blending {

inline constexpr std::size_t spline_degree = 5;
inline constexpr std::size_t spline_order = spline_degree + 1;

/// Entry [k][i] is the k-th derivative of the i-th of the six.
using BasisRow = BsplineBasis<spline_order>;

/// Returns the knots: the breaks with both ends repeated six times. The spline has four continuous derivatives inside
/// and interpolates its first and last control point.
std::vector<double> clamped_knots(const std::vector<double>& breaks);

/// Evaluates the basis functions span … span + 5 at t in [breaks[span], breaks[span + 1]]. O(degree²).
BasisRow basis_at(const std::vector<double>& knots, std::size_t span, double t);
/// These leave derivatives 0: the first one those of order 3, the second one all. They take two thirds and a fifth of
/// the time of basis_at().
BasisRow second_derivative_basis_at(const std::vector<double>& knots, std::size_t span, double t);
BasisRow value_basis_at(const std::vector<double>& knots, std::size_t span, double t);

/// Returns the third derivatives of the six basis functions at `Count` places of one interval. They are combinations of
/// three quadratic B-splines, so the divisions by interval lengths are done once for all places.
template <std::size_t Count>
std::array<std::array<double, spline_order>, Count> third_basis_at(const std::vector<double>& knots, std::size_t span,
                                                                   const std::array<double, Count>& places) {
  const double* const u = &knots[span];  // the interval is [u[5], u[6]]
  // Row i expresses control point i of f', then of f'', then of f''' by the control points of f.
  std::array<std::array<double, spline_order>, spline_order> row{};
  for (std::size_t i = 0; i < spline_order; ++i) row[i][i] = 1;
  for (std::size_t order = 1; order <= 3; ++order)
    for (std::size_t i = 0; i + order < spline_order; ++i) {
      const double rate = static_cast<double>(spline_order - order) / (u[i + spline_order] - u[i + order]);
      for (std::size_t j = i; j <= i + order; ++j) row[i][j] = rate * (row[i + 1][j] - row[i][j]);
    }
  const double inner = 1 / (u[6] - u[5]), left = 1 / (u[6] - u[4]), right = 1 / (u[7] - u[5]);
  std::array<std::array<double, spline_order>, Count> basis;
  for (std::size_t p = 0; p < Count; ++p) {
    const double t = places[p], a = (u[6] - t) * inner, b = (t - u[5]) * inner;
    const double first = (u[6] - t) * left * a, last = (t - u[5]) * right * b,
                 middle = (t - u[4]) * left * a + (u[7] - t) * right * b;
    for (std::size_t j = 0; j < spline_order; ++j)
      basis[p][j] = first * row[0][j] + middle * row[1][j] + last * row[2][j];
  }
  return basis;
}

}  // namespace bahnwerk::blending
