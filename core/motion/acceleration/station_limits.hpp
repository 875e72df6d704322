#pragma once
/// The axis limits at one station of a curved cell, as rows of the link between v² there and the cell's middle
/// coefficient.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/motion/acceleration/reach.hpp"
#include "core/motion/grid/grid.hpp"

namespace bahnwerk {

/// Limits in the form that the inner loop needs.
template <int N>
struct AxisBounds {
  Lanes<N> velocity{}, acceleration{};
  Lanes<N> velocity2{}, inverse_acceleration{};  ///< V², 1/A
  double slowest2 = unlimited;                   ///< least V²
  explicit AxisBounds(const Machine& machine) {
    for (std::size_t k = 0; k < N; ++k) {
      velocity[k] = machine.axes[k].velocity;
      acceleration[k] = machine.axes[k].acceleration;
      velocity2[k] = velocity[k] * velocity[k];
      slowest2 = std::min(slowest2, velocity2[k]);
      inverse_acceleration[k] = 1 / acceleration[k];
    }
  }
};

template <int N>
using Rows = LinkRows<2 * N + 1>;

/// Rows of the link (b at the station, g). `h` is the cell's length, negative at its right end; the path acceleration
/// is (g − b)/h. `share` is the usable part of the limits. `Flip` exchanges the variables' order: (g, b).
template <int N, bool Flip>
inline void acceleration_rows(Rows<N>& rows, const Station<N>& at, double h, double share, const AxisBounds<N>& limit) {
  const double w = 1 / h;
  for (std::size_t k = 0; k < N; ++k) {
    const double A = share * limit.acceleration[k];
    const double t = w * at.d1[k], p = at.d2[k] - t;
    Flip ? rows.add(t, p, A) : rows.add(p, t, A);
    // Where the axis reverses (h'_k ≈ 0, a zero-inertia point) its acceleration hardly depends on a, but its slope
    // h''' v² + 3 h'' a does; without this row the law would oscillate around the point. The neglected term h'_k da/ds
    // is of second order in the cell there.
    if (std::abs(at.d1[k]) < 4 * std::abs(h * at.d2[k])) {
      const double tilt = t + at.d2[k], shift = at.d2[k] + h / 3 * at.d3[k] - tilt;
      Flip ? rows.add(tilt, shift, A) : rows.add(shift, tilt, A);
    }
  }
}

/// The part of a station that a plain link needs for either neighbouring cell: h''_k/h'_k and A_k/|h'_k|. An axis that
/// stands still (as y does along a path in the XZ plane) gives 0 and ∞.
template <int N>
struct PlainStation {
  Lanes<N> tilt, reach;
  PlainStation(const Station<N>& at, const AxisBounds<N>& limit) {
    const Lanes<N> inverse = 1 / at.d1;
    tilt = at.d2 * inverse;
    reach = limit.acceleration * magnitude(inverse);
    if constexpr (N > 2)  // a curve moves two axes at least
      for (std::size_t k = 0; k < N; ++k)
        if (at.d1[k] == 0 && at.d2[k] == 0) tilt[k] = 0;
  }
};

/// Rows of a plain link. Where no axis reverses near the station, |h'_k| ≥ 4 |h h''_k|, all rows rise together and
/// reach.hpp needs no search. Divided by |h'_k|/h, with t = h h''_k/h'_k and w = h A_k/|h'_k|, the row of axis k is |t
/// b + g − b| ≤ w at the cell's left end and |t b + b − g| ≤ w at its right end.
template <int N>
class PlainLink {
 public:
  PlainLink(const PlainStation<N>& at, double h, double share) : tilt_(h * at.tilt), width_(share * h * at.reach) {}
  bool plain() const {
    const Lanes<N> size = magnitude(tilt_);
    bool plain = true;
    for (std::size_t k = 0; k < N; ++k) plain = plain && size[k] <= 0.25;
    return plain;
  }

  /// Returns the largest second variable for a given first one; the round-off margin absorbs the rounding of x.
  /// Divisions come first: each speed depends on the one before, so the operations between them determine the time of a
  /// pass.
  double forward_left(double b, double cap) const { return reached((round_off_margin - tilt_) * b + width_, cap); }
  double forward_right(double g, double cap) const {
    const Lanes<N> factor = round_off_margin / (1 + tilt_);
    return reached(factor * g + factor * width_, cap);
  }
  /// Returns the largest first variable for which a second one, up to a cap, exists. Row k is |x − f_k y| ≤ w_k with
  /// f_k > 0, so the largest x belongs to the largest y that all rows allow.
  double backward_left(double cap_b, double cap_g) const {
    const Lanes<N> factor = 1 / (1 - tilt_);
    return largest(factor, factor * width_, cap_b, cap_g);
  }
  double backward_right(double cap_g, double cap_b) const { return largest(1 + tilt_, width_, cap_g, cap_b); }

 private:
  static constexpr double round_off_margin = 1 + 1e-13;
  static double reached(const Lanes<N>& line, double cap) {
    for (std::size_t k = 0; k < N; ++k) cap = std::min(cap, line[k]);
    return cap;
  }
  static double largest(const Lanes<N>& f, const Lanes<N>& w, double cap_x, double y) {
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = i + 1; k < N; ++k)
        if (const double apart = std::abs(f[i] - f[k]), both = w[i] + w[k]; apart * y > both) y = both / apart;
    return reached(f * y + w, cap_x);
  }
  Lanes<N> tilt_, width_;
};

/// The limit curve of [Bock 2.2.3]: v↓² = min(feed², V²/h'², K_b A/|h''|) of (2.12)–(2.15), and the acceleration a↓
/// below it, (2.16) with |h''| v↓² in place of the printed |h'' v↓|². Condition (2.11) is applied with h'' (printed:
/// h').
struct ReserveLimit {
  double speed2 = 0;        ///< v↓²
  double acceleration = 0;  ///< a↓
};
template <int N>
inline ReserveLimit reserve_limit(const Station<N>& at, const AxisBounds<N>& limit, double feed, double reserve) {
  ReserveLimit r{feed * feed, std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < N; ++k) {
    const double t = std::abs(at.d1[k]), c = std::abs(at.d2[k]);
    if (t > 0) r.speed2 = std::min(r.speed2, limit.velocity[k] * limit.velocity[k] / (t * t));
    if (c > 0) r.speed2 = std::min(r.speed2, reserve * limit.acceleration[k] / c);
  }
  for (std::size_t k = 0; k < N; ++k) {
    const double t = std::abs(at.d1[k]), c = std::abs(at.d2[k]);
    const double used = c > 0 ? c * r.speed2 : 0;
    if (t > 0) r.acceleration = std::min(r.acceleration, (limit.acceleration[k] - used) / t);
  }
  return r;
}

/// Returns the largest middle coefficient g for a cap φ(s) on v² over a cell, from its values and slopes at both ends.
/// It keeps v² below φ to third order when the ends touch it, and safely below it otherwise.
inline double middle_cap(double left, double left_slope, double right, double right_slope, double h) {
  const double tangents = std::min(left + 0.5 * h * left_slope, right - 0.5 * h * right_slope);
  return std::max(tangents, std::min(left, right));
}

}  // namespace bahnwerk
