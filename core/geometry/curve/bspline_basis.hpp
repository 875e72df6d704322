#pragma once
/// The B-splines that do not vanish at a place, with their derivatives [Piegl, Tiller: The NURBS Book, A2.3].
#include <array>
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// Entry [o][r] is the derivative of order o of the r-th of the degree + 1 basis functions that do not vanish between
/// knots[k] and knots[k + 1].
template <std::size_t Limit>
using BsplineBasis = std::array<std::array<double, Limit>, 4>;

/// Evaluates the values alone, for a degree known to the compiler; `knots` points to knots[k]. The results equal those
/// of bspline_basis() bit for bit; only one row of the triangle is stored [A2.2].
template <std::size_t degree>
inline void bspline_values(const double* knots, double u, double* values) {
  std::array<double, degree + 1> left{}, right{};
  values[0] = 1;
  for (std::size_t j = 1; j <= degree; ++j) {
    left[j] = u - *(knots - (j - 1));
    right[j] = knots[j] - u;
    double saved = 0;
    for (std::size_t r = 0; r < j; ++r) {
      const double share = values[r] / (right[r + 1] + left[j - r]);
      values[r] = saved + right[r + 1] * share;
      saved = left[j - r] * share;
    }
    values[j] = saved;
  }
}

/// Evaluates at u up to order min(Most, degree); degree < Limit. O(degree²), mostly for the derivatives.
template <std::size_t Limit, std::size_t Most = 3>
inline BsplineBasis<Limit> bspline_basis(const std::vector<double>& knots, std::size_t degree, std::size_t k,
                                         double u) {
  const std::size_t p = degree, orders = p < Most ? p : Most;
  // ndu is the triangle of basis functions (upper part) and knot differences (lower part).
  std::array<std::array<double, Limit>, Limit> ndu{};
  std::array<double, Limit> left{}, right{};
  ndu[0][0] = 1;
  for (std::size_t j = 1; j <= p; ++j) {
    left[j] = u - knots[k + 1 - j];
    right[j] = knots[k + j] - u;
    double saved = 0;
    for (std::size_t r = 0; r < j; ++r) {
      ndu[j][r] = right[r + 1] + left[j - r];
      const double share = ndu[r][j - 1] / ndu[j][r];
      ndu[r][j] = saved + right[r + 1] * share;
      saved = left[j - r] * share;
    }
    ndu[j][j] = saved;
  }
  BsplineBasis<Limit> basis{};
  for (std::size_t r = 0; r <= p; ++r) {
    basis[0][r] = ndu[r][p];
    std::array<std::array<double, 4>, 2> a{};
    std::size_t now = 0;
    a[0][0] = 1;
    double factor = 1;
    for (std::size_t o = 1; o <= orders; ++o) {
      const std::size_t next = 1 - now, rest = p - o;
      double sum = 0;
      for (std::size_t j = 0; j <= o; ++j) {  // a_{o,j} for basis function r + j − o of degree p − o
        const double here = j < o ? a[now][j] : 0.0, before = j > 0 ? a[now][j - 1] : 0.0;
        double value = 0;
        if (r + j >= o && r + j - o <= rest) {
          value = (here - before) / ndu[rest + 1][r + j - o];
          sum += value * ndu[r + j - o][rest];
        }
        a[next][j] = value;
      }
      factor *= static_cast<double>(rest + 1);
      basis[o][r] = factor * sum;
      now = next;
    }
  }
  return basis;
}

}  // namespace bahnwerk
