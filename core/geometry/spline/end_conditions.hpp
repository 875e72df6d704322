#pragma once
/// Control points of a piece from derivatives at its ends.
#include <array>
#include <cstddef>

#include "core/geometry/spline/bezier_piece.hpp"

namespace bahnwerk {

/// Returns Bézier point i ≤ 4 of degree p from the derivatives at v = 0: P_i = Σ_j C(i,j) (p − j)!/p! s⁽ʲ⁾(0). For the
/// other end, points count from there and derivatives are by 1 − v.
inline double end_point(const std::array<double, spline_orders>& derivatives, std::size_t degree, std::size_t i) {
  double sum = 0, choose = 1, falling = 1;  // C(i, j), p!/(p − j)!
  for (std::size_t j = 0; j <= i; ++j) {
    sum += choose / falling * derivatives[j];
    choose *= static_cast<double>(i - j) / static_cast<double>(j + 1);
    falling *= static_cast<double>(degree - j);
  }
  return sum;
}

}  // namespace bahnwerk
