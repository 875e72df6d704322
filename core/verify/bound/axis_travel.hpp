#pragma once
/// Limits of the motion of single axes between two nodes of the bound.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/numeric/lanes.hpp"
#include "core/verify/bound/bound_node.hpp"

namespace bahnwerk::verify {

inline constexpr double negligible_direction = 1e-24;  ///< an axis with q'_k² below this does not limit b

/// Returns the shortest time over the distance `way`, mm, that begins with speed² ≤ e0 and ends with speed² ≤ e1: the
/// axis accelerates, cruises and brakes. If the distance is too short for one end speed given the other, that end speed
/// is reduced first, since e0 and e1 are bounds that include the rounding of q′, which is large next to a vanishing
/// tangent.
inline double travel_time(double e0, double e1, double way, double acceleration, double velocity) {
  if (!(way > 0)) return 0;
  e0 = std::min({e0, velocity * velocity, e1 + 2 * acceleration * way});
  e1 = std::min({e1, velocity * velocity, e0 + 2 * acceleration * way});
  const double energy = acceleration * way, up = std::max(0.0, (e1 - e0) / 2 + energy),
               down = std::max(0.0, (e0 - e1) / 2 + energy);
  const double v0 = std::sqrt(e0), v1 = std::sqrt(e1), top = std::sqrt(std::max(e0 + up, e1 + down));
  if (top <= velocity) return (up / (top + v0) + down / (top + v1)) / acceleration;
  const double start = std::min(v0, velocity), end = std::min(v1, velocity);
  const double ramps = (velocity * velocity - start * start + velocity * velocity - end * end) / (2 * acceleration);
  return (velocity - start + velocity - end) / acceleration + std::max(0.0, way - ramps) / velocity;
}

/// Returns the largest of the axes' travel times (travel_time()).
template <int N>
double slowest(Lanes<N> e0, Lanes<N> e1, Lanes<N> way, Lanes<N> acceleration, Lanes<N> velocity) {
  const Lanes<N> none{}, energy = acceleration * way;
  e0 = smaller(smaller(e0, velocity * velocity), e1 + 2 * energy);
  e1 = smaller(smaller(e1, velocity * velocity), e0 + 2 * energy);
  const Lanes<N> half = 0.5 * (e1 - e0);
  const Lanes<N> up = larger(none, half + energy), down = larger(none, energy - half);
  const Lanes<N> v0 = root(e0), v1 = root(e1), top = root(larger(e0 + up, e1 + down));
  const Lanes<N> times = (up / (top + v0) + down / (top + v1)) / acceleration;
  double longest = 0;
  for (std::size_t k = 0; k < N; ++k)
    if (way[k] > 0)
      longest = std::max(
          longest, top[k] <= velocity[k] ? times[k] : travel_time(e0[k], e1[k], way[k], acceleration[k], velocity[k]));
  return longest;
}

/// Return bounds of q'_k² of all axes at a node, rounding included.
template <int N>
Lanes<N> most(const BoundNode<N>& n) {
  const Lanes<N> t = n.rounding_error + magnitude(lanes(n.tangent));
  return t * t;
}
template <int N>
Lanes<N> least(const BoundNode<N>& n) {
  const Lanes<N> t = larger(Lanes<N>{}, -(n.rounding_error - magnitude(lanes(n.tangent))));
  return t * t;
}

/// Returns the largest b' at node `to` of a cell, given b at node `from`: q b' ≤ p b + energy for every axis, with p, q
/// the values of q'_k² at both nodes.
template <int N>
double across(const BoundCell<N>& cell, const BoundNode<N>& from, const BoundNode<N>& to, double b) {
  if (cell.kind == BoundCell<N>::Kind::joint) return b + cell.slip;
  const Lanes<N> q = least(to), allowed = (most(from) * b + lanes(cell.energy)) / q;
  double least_allowed = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < N; ++k)
    if (q[k] > negligible_direction) least_allowed = std::min(least_allowed, allowed[k]);
  return least_allowed;
}

}  // namespace bahnwerk::verify
