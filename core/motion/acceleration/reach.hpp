#pragma once
/// One-step reachable and controllable sets [Pham, Pham 2018] between two neighbouring variables of a chain of speeds.
///
/// Two neighbouring variables x, y are linked by half-planes. The reachable set of a given x is [0, largest y]; the
/// controllable set of an allowed y is [0, largest x].
///
/// Inside a grid cell of length Δ, b = v² is a quadratic in s with Bernstein coefficients b1, g, b2. The path
/// acceleration is (g − b1)/Δ at the left and (b2 − g)/Δ at the right. An axis acceleration h'' b + h' a [Bock (2.7)]
/// at the left station is therefore linear in (b1, g), at the right one in (g, b2). A whole section is one chain b1 g
/// b2 g b3 … of variables whose links are polygons around the origin.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace bahnwerk {

/// A polygon: at most M pairs of half-planes |p x + q y| ≤ c between the variables x, y of a link. The origin satisfies
/// all.
template <int M>
struct LinkRows {
  std::array<double, M> p, q, c;
  int n = 0;
  void add(double px, double qy, double limit) {
    p[static_cast<std::size_t>(n)] = px;
    q[static_cast<std::size_t>(n)] = qy;
    c[static_cast<std::size_t>(n)] = limit;
    ++n;
  }
};

/// Returns the largest y ≤ cap for a given x for which some y ∈ [0, cap] exists. O(rows), no branches.
template <int M>
double reach_forward(const LinkRows<M>& rows, double x, double cap) {
  double best = cap;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rows.n); ++i) {
    const double q = std::abs(rows.q[i]);
    const double p = std::copysign(rows.p[i], rows.p[i] * rows.q[i]);  // sign(q) · p
    // The slack absorbs the rounding of x where q is tiny; q = 0 gives infinity.
    const double bound = (rows.c[i] * (1 + 1e-13) - p * x) / q;
    best = bound < best ? bound : best;
  }
  return std::max(best, 0.0);
}

/// Returns the largest x ≤ cap_x for which some y ∈ [0, cap_y] satisfies every row: a linear program in two variables,
/// solved along the edges of the polygon from y = cap_y. It usually takes one or two steps of O(rows).
template <int M>
double reach_backward(const LinkRows<M>& rows, double cap_x, double cap_y) {
  const auto n = static_cast<std::size_t>(rows.n);
  double y = cap_y;
  for (int step = 0; step < 3 * M; ++step) {
    // The tightest upper and lower bound on x at this y are computed, with their slopes dx/dy.
    double upper = cap_x, upper_slope = 0, upper_margin = 0, lower = 0, lower_slope = 0, lower_margin = 0, most = y;
    for (std::size_t i = 0; i < n; ++i) {
      const double p = std::abs(rows.p[i]);
      if (!(p * cap_x > 1e-9 * rows.c[i])) {  // the row is practically a limit on y alone
        most = std::min(most, (rows.c[i] - (p > 0 ? p * cap_x : 0)) / std::abs(rows.q[i]));
        continue;
      }
      const double slope = -std::copysign(rows.q[i], rows.p[i] * rows.q[i]) / p;
      const double width = rows.c[i] / p, middle = slope * y;
      // At a vertex, the line of larger slope leads on to smaller y. The margin is rounding, 1e-13 of the row.
      const double line = middle + width, margin = 1e-13 * (width + std::abs(middle));
      if (line < upper - margin || (line < upper + margin && slope > upper_slope)) {
        upper = std::min(line, upper);
        upper_slope = slope;
        upper_margin = margin;
      }
      if (middle - width > lower) {
        lower = middle - width;
        lower_slope = slope;
        lower_margin = margin;
      }
    }
    if (most < y) {  // a limit on y alone
      y = most;
      continue;
    }
    if (lower - upper > lower_margin + upper_margin) {  // y is too large: continue where the two lines meet
      const double gain = lower_slope - upper_slope;
      if (!(gain > 0)) return std::max(0.0, upper);  // rounding only: the origin is feasible
      y = std::max(0.0, y - (lower - upper) / gain);
      if (y == 0) return std::min(cap_x, upper);
      continue;
    }
    if (upper_slope >= 0 || y <= 0) return upper;
    // With smaller y, x grows along the active line until a line of larger slope becomes active.
    double next = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double p = std::abs(rows.p[i]);
      if (!(p * cap_x > 1e-9 * rows.c[i])) continue;
      const double slope = -std::copysign(rows.q[i], rows.p[i] * rows.q[i]) / p;
      if (!(slope > upper_slope)) continue;
      const double here = slope * y + rows.c[i] / p;  // ≥ upper
      next = std::max(next, y - (here - upper) / (slope - upper_slope));
    }
    if (cap_x < std::numeric_limits<double>::infinity()) next = std::max(next, y - (cap_x - upper) / -upper_slope);
    if (!(next < y * (1 - 1e-15))) return upper;
    y = next;
  }
  return 0;  // this is not reached: each step visits another vertex
}

}  // namespace bahnwerk
