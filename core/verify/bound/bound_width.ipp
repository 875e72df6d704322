#pragma once
// Chooses the width of cells by samples, which affects the tightness of the bound, not its validity.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/verify/bound/bound_grid.hpp"

namespace bahnwerk::verify {
namespace {

// A valley of the caps inside counts from this on, a share of them.
constexpr double shallow = 2e-5, slight_turn = 1e-4;

template <std::size_t N>
std::array<double, N> difference(const std::array<double, N>& a, const std::array<double, N>& b) {
  std::array<double, N> d;
  for (std::size_t k = 0; k < N; ++k) d[k] = a[k] - b[k];
  return d;
}
}  // namespace

// Returns whether the curve between a and b may differ from what values at the two nodes suggest.
template <int N>
bool BoundGrid<N>::too_wide(const Node& a, const Node& b) const {
  const double length = b.s - a.s;
  double turn = length_of(difference(b.tangent, a.tangent));
  if (turn > turn_) return true;
  if (path_.cartesian()) {
    turn *= 1 + turn * turn / 24;  // the angle whose chord that was
    if (turn > turn_) return true;
    const double chord = length_of(difference(b.position, a.position));
    const double slack =
        1e-12 * path_[a.segment].length() + 8 * epsilon * (length_of(a.position) + length_of(b.position));
    if (length - chord > sq(turn_) / 16 * length + slack) return true;
  } else {
    for (std::size_t k = 0; k < axes_; ++k) {
      const double trapezoid = (a.tangent[k] + b.tangent[k]) / 2 * length;
      if (std::abs(b.position[k] - a.position[k] - trapezoid) > turn_ / 4 * length) return true;
    }
  }
  const double trapezoid = (length_of(a.curvature) + length_of(b.curvature)) / 2 * length;
  return std::abs(trapezoid - turn) > turn / 4 + turn_ / 20;
}

template <int N>
bool BoundGrid<N>::changes(const Node& a, const Node& middle, const Node& b) const {
  const double q2 = std::max({length_of(a.curvature), length_of(middle.curvature), length_of(b.curvature)});
  if (q2 * (b.s - a.s) < slight_turn) return false;
  const double change = std::max(length_of(difference(middle.curvature, a.curvature)),
                                 length_of(difference(b.curvature, middle.curvature)));
  return change > change_ * q2;
}

// The maximum velocity curve may be lower inside than between the ends. Told by a third place, and by how much it is
// off the line through the others.
template <int N>
double BoundGrid<N>::valley(const Node& a, const Node& middle, const Node& b) const {
  const double q2 = std::max({length_of(a.curvature), length_of(middle.curvature), length_of(b.curvature)});
  if (q2 * (b.s - a.s) < slight_turn) return unlimited;
  const double cap = turn_cap(middle), off = std::abs(turn_cap(a) - 2 * cap + turn_cap(b));
  if (!std::isfinite(off)) return cap;
  return off > shallow * cap ? cap - off / 4 : unlimited;
}

}  // namespace bahnwerk::verify
