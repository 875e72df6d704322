#pragma once
/// Values of a cell's rows (core/probe/optimal/cell_basis.hpp) and the slacks of its constraints.
#include <algorithm>
#include <cmath>

#include "core/probe/optimal/cell_basis.hpp"
#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

/// A segment p + s u, 0 ≤ s ≤ length (mm), |u| = 1 (u = 0 where length = 0), and the square of the radius around it.
template <int D>
struct Capsule {
  std::array<double, D> p, u;
  double length = 0, radius2 = 0;
};

template <int D>
Capsule<D> capsule(const std::array<double, D>& from, const std::array<double, D>& to, double radius) {
  Capsule<D> c{from, {}, 0, radius * radius};
  double sum = 0;
  for (int k = 0; k < D; ++k) sum += (to[k] - from[k]) * (to[k] - from[k]);
  c.length = std::sqrt(sum);
  for (int k = 0; k < D; ++k) c.u[k] = c.length > 0 ? (to[k] - from[k]) / c.length : 0;
  return c;
}

/// Returns the vector from the nearest point of the segment to q; sets `cap`: that point is an end.
template <int D>
inline std::array<double, D> offset(const Capsule<D>& c, const double* q, bool& cap) {
  double along = 0;
  for (int k = 0; k < D; ++k) along += (q[k] - c.p[k]) * c.u[k];
  cap = along <= 0 || along >= c.length;
  along = std::clamp(along, 0.0, c.length);
  std::array<double, D> d;
  for (int k = 0; k < D; ++k) d[k] = q[k] - c.p[k] - along * c.u[k];
  return d;
}

/// The number of slacks of a cell: 17 for the tube, 13 for the speed, upper and lower ones for 18 rows and D axes, and
/// 1 for the duration.
template <int D>
inline constexpr std::size_t cell_slacks = 30 + 36 * D + 1;

template <int D>
struct CellValues {
  double q[CellBasis::rows][D];  ///< values with respect to time
  double y[8][D];                ///< states at both ends over the cell's own time
  double power[5];               ///< duration^−r
};

template <int D>
inline void evaluate_cell(const ChainNode<D>& a, const ChainNode<D>& b, double h, CellValues<D>& out) {
  const CellBasis& basis = cell_basis();
  double up = 1;
  for (int p = 0; p < 4; ++p, up *= h)
    for (int k = 0; k < D; ++k) {
      out.y[p][k] = a.state[p][k] * up;
      out.y[4 + p][k] = b.state[p][k] * up;
    }
  out.power[0] = 1;
  for (int r = 1; r < 5; ++r) out.power[r] = out.power[r - 1] / h;
  for (int k = 0; k < D; ++k) {
    double y[8];
    for (int c = 0; c < 8; ++c) y[c] = out.y[c][k];
    // Sums of positions are taken relative to the first one: differences of large coordinates lose nothing.
    const double base = y[0];
    y[4] -= base;
    y[0] = 0;
    for (std::size_t r = 0; r < CellBasis::rows; ++r) {
      const double* row = basis.row[r];
      double sum = 0;
      for (int c = basis.from[r]; c < basis.to[r]; ++c) sum += row[c] * y[c];
      out.q[r][k] = r < CellBasis::first[1] ? base + sum : sum * out.power[basis.order[r]];
    }
  }
}

}  // namespace bahnwerk
