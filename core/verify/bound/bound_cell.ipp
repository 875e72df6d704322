#pragma once
// Conditions that every motion satisfies at a node and between two of them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/curve/arc.hpp"
#include "core/verify/bound/bound_grid.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double no_direction = 1e-12;  // |q'_k| below this: the axis stands still, its conditions are dropped
constexpr double give = 1 + 1e-11;      // caps are increased by the rounding of curvatures
constexpr double slow = 1e-3;           // |q'_m| below this: what the axis allows along the path is not used

// 12 (1 − x/tan x)/(4x²) with x = turn/2: what the curvature term of the trapezoid rule lacks on a circle. At most a
// few 1e-2 rad.
double circle_factor(double turn) {
  const double q = turn * turn;
  return 1 + q / 60 + q * q / 2520;
}

}  // namespace

template <int N>
void BoundGrid<N>::learn(std::size_t segment) const {
  const Segment& s = path_[segment];
  const Curve& curve = s.curve();
  shape_of_ = segment;
  shape_ = {};
  shape_.first = curve.begin(), shape_.last = curve.end();
  shape_.linear = path_.cartesian() ? s.straight() : path_.linear(segment);
  if (curve.kind() == CurveKind::rational) shape_.rational = static_cast<const Rational*>(&curve);
  if (curve.kind() != CurveKind::arc) return;
  const Arc& arc = static_cast<const Arc&>(curve);
  const double turn = std::abs(arc.sweep()) / arc.length() * (1 + 8 * epsilon);  // rad/mm
  shape_.arc = &arc;
  shape_.third = arc.radius() * turn * turn * turn;
}

template <int N>
BoundNode<N> BoundGrid<N>::place(std::size_t segment, double u) const {
  const Segment& s = path_[segment];
  Node n;
  n.u = u, n.segment = static_cast<std::uint32_t>(segment);
  if (path_.cartesian()) {
    Jet h;
    if (const Arc* arc = shape(segment).arc) {  // an arc has constant parametric speed
      h = arc->at(u);
      const double inverse = 1 / arc->length(), square = inverse * inverse;
      h.d1 = inverse * h.d1, h.d2 = square * h.d2;
    } else {
      h = s.at_parameter(u);
    }
    n.position[0] = h.value.x, n.tangent[0] = h.d1.x, n.curvature[0] = h.d2.x;
    n.position[1] = h.value.y, n.tangent[1] = h.d1.y, n.curvature[1] = h.d2.y;
    if constexpr (N > 2) n.position[2] = h.value.z, n.tangent[2] = h.d1.z, n.curvature[2] = h.d2.z;
  } else {
    const AxisJet q = path_.at_parameter(segment, u);
    for (std::size_t k = 0; k < axes_; ++k) {
      if (still_[k]) continue;
      n.position[k] = scale_[k] * q.value[k], n.tangent[k] = scale_[k] * q.d1[k], n.curvature[k] = scale_[k] * q.d2[k];
    }
    n.rounding_error = 64 * epsilon;
  }
  return n;
}

template <int N>
void BoundGrid<N>::complete(Node& n) const {
  const Segment& s = path_[n.segment];
  const Shape& known = shape(n.segment);
  const double u = n.u;
  if (known.arc != nullptr) n.rounding_error = std::max(n.rounding_error, 6 * epsilon);
  if (known.rational != nullptr && !s.straight()) {
    const Rational& rational = *known.rational;
    n.rounding_error += std::min(1e-3, 16 * epsilon * (1 + rational.extent() / (rational.speed(u) * rational.reach())));
  }
  n.s = s.travelled(u);
  const bool cusp = (u <= known.first && s.cusp_begin()) || (u >= known.last && s.cusp_end());
  if (cusp || known.linear) n.curvature = {};
  n.cap = cusp ? 0 : place_cap(n);
}

// Velocity, feed, and that.
template <int N>
double BoundGrid<N>::place_cap(const Node& n) const {
  double cap = std::min(sq(feeds_[n.segment]), turn_cap(n));
  for (std::size_t k = 0; k < axes_; ++k)
    if (n.least(k) > 0) cap = std::min(cap, sq(velocity_[k]) / n.least(k));
  return cap;
}

// Jerk of axis k: |q'''_k v³ + 3 q''_k v v̇ + q'_k v̈| ≤ J_k. What another axis m leaves of v̇ and v̈,
// |v̇| ≤ (A_m + |q''_m| v²)/|q'_m| and |v̈| ≤ (J_m + |q'''_m| v³ + 3 |q''_m| v |v̇|)/|q'_m|, makes it c₃ v³ ≤ c₀ + c₁ v,
// which bounds v where c₃ > 0: where axis k hardly moves, but is about to.
template <int N>
double BoundGrid<N>::jerk_cap(const AxisSizes& sizes) const {
  double cap = unlimited;
  const auto most = [](double low, double high) { return std::max(std::abs(low), std::abs(high)); };
  for (std::size_t m = 0; m < axes_; ++m) {
    const double rate = std::max(sizes.low[m], -sizes.high[m]);  // |q'_m| from below
    if (!(rate > slow) || !std::isfinite(jerk_[m])) continue;
    const double q2 = most(sizes.q2_low[m], sizes.q2_high[m]) / rate, along = acceleration_[m] / rate;
    for (std::size_t k = 0; k < axes_; ++k) {
      if (k == m || !std::isfinite(jerk_[k]) || !(sizes.least_third[k] > 0)) continue;
      const double d1 = most(sizes.low[k], sizes.high[k]), d2 = most(sizes.q2_low[k], sizes.q2_high[k]),
                   weight = 3 * (d2 + d1 * q2);  // factor of v |v̇|
      const double c3 = sizes.least_third[k] - d1 * sizes.third[m] / rate - weight * q2, c1 = weight * along,
                   c0 = jerk_[k] + d1 * jerk_[m] / rate;
      if (!(c3 > 0) || !std::isfinite(c0 + c1)) continue;
      double v =
          std::cbrt(c0 / c3) + std::sqrt(c1 / c3);  // an upper bound of the root; Newton's steps stay above the root
      for (int i = 0; i < 4; ++i) v -= (c3 * v * v * v - c1 * v - c0) / (3 * c3 * v * v - c1);
      cap = std::min(cap, sq(v * give));
    }
  }
  return cap;
}

// The maximum velocity curve: b for which accelerations of all axes still fit together.
template <int N>
double BoundGrid<N>::turn_cap(const Node& n) const {
  double cap = unlimited;
  for (std::size_t k = 0; k < axes_; ++k) {
    const double t = std::abs(n.tangent[k]);
    for (std::size_t m = 0; m < k; ++m) {
      const double turn = std::abs(n.tangent[m] * n.curvature[k] - n.tangent[k] * n.curvature[m]);
      const double reach = acceleration_[k] * std::abs(n.tangent[m]) + acceleration_[m] * t;
      if (turn > 0 && reach > 0) cap = std::min(cap, reach / turn * (give + 16 * n.rounding_error));
    }
  }
  return cap;
}

template <int N>
double BoundGrid<N>::along(const Node& a, const Node& b, double cap) const {
  double most = std::numeric_limits<double>::infinity();
  for (const Node* n : {&a, &b})
    for (std::size_t k = 0; k < axes_; ++k)
      if (n->least(k) > 0)
        most = std::min(most, (acceleration_[k] + std::abs(n->curvature[k]) * cap) / std::sqrt(n->least(k)));
  return most;
}

// Under a limit of jerk the acceleration of an axis may step by jerk · cycle time, |Δq''_k b + Δq'_k v̇| at most, and
// the acceleration v̇ along the path does not step.
template <int N>
double BoundGrid<N>::step_cap(const Node& a, const Node& b, double cap) const {
  const double most_along = along(a, b, cap);
  double most = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < axes_; ++k) {
    const double step = std::abs(b.curvature[k] - a.curvature[k]), tangent_jump = std::abs(b.tangent[k] - a.tangent[k]);
    const double allowed = jerk_[k] * cycle_time_ + (tangent_jump > 0 ? tangent_jump * most_along : 0);
    if (step > 0 && allowed < most * step) most = allowed / step * give;
  }
  return most;
}

// Returns the jump of the tool's direction.
template <int N>
double BoundGrid<N>::corner(const Node& a, const Node& b) const {
  if (unit_direction(a) && unit_direction(b)) return angle_between(direction(a.tangent), direction(b.tangent));
  const Segment &before = path_[a.segment], &after = path_[b.segment];
  return angle_between(before.at_parameter(a.u).d1, after.at_parameter(b.u).d1);
}

template <int N>
bool BoundGrid<N>::unit_direction(const Node& n) const {
  double square = 0;
  for (const double t : n.tangent) square += sq(t);
  return path_.cartesian() && axes_ == N && std::abs(square - 1) < 1e-9;
}

template <int N>
BoundCell<N> BoundGrid<N>::cell(Node& a, Node& b, const DirectionRange<N>* range) const {
  Cell c;
  for (std::size_t k = axes_; k < N; ++k) c.energy[k] = unlimited;
  if (a.segment != b.segment) {
    double cap = std::min(a.cap, b.cap);
    for (std::size_t k = 0; k < axes_; ++k)
      if (const double step = b.tangent[k] - a.tangent[k]; step != 0)
        cap = std::min(cap, sq(acceleration_[k] * cycle_time_ / step) * give);
    cap = std::min(cap, step_cap(a, b, cap));
    a.cap = b.cap = corner(a, b) > corner_angle_ ? 0 : cap;
    return c;
  }
  const Shape known = shape(a.segment);
  c.length = b.s - a.s;
  if (const double rounding_error = rounding_of(path_length(b)); c.length <= rounding_error && unit_direction(a)) {
    // Differences over such a cell are rounding: only |d(v²)/ds| ≤ 2 |A| is required of it.
    double square = 0;
    for (std::size_t k = 0; k < axes_; ++k) square += sq(acceleration_[k]);
    c.slip = 2 * std::sqrt(square) * (c.length + rounding_error);
    return c;
  }
  c.kind = known.linear ? Cell::Kind::straight : Cell::Kind::curved;
  const bool arc = path_.cartesian() && known.arc != nullptr;
  double q2 = 0, position_error = 0;
  if (arc) {
    q2 = sq(c.length) / 12 * circle_factor(known.arc->sweep() * (b.u - a.u));
  } else if (c.kind == Cell::Kind::curved) {
    double size = length_of(a.position) + length_of(b.position);
    if (known.rational != nullptr) size += known.rational->extent();
    position_error = 4 * epsilon * size;
    if (!path_.cartesian())
      position_error = 4 * position_error + 16 * epsilon * norm(path_[a.segment].curve().at(a.u).value);
  }
  if (c.kind == Cell::Kind::curved && range == nullptr) {
    const DirectionRange<N> own = this->range(a, b);
    return cell(a, b, &own);
  }
  for (std::size_t k = 0; k < axes_; ++k) {
    double way = 0;
    if (c.kind == Cell::Kind::straight)
      way = std::abs(a.tangent[k]) * c.length;
    else if (arc)  // ∫h' ds from both ends without cancellation, exact on circles and helices
      way = std::abs((a.tangent[k] + b.tangent[k]) / 2 * c.length + q2 * (a.curvature[k] - b.curvature[k]));
    else
      way = std::abs(b.position[k] - a.position[k]);
    c.displacement[k] = std::max(0.0, way * (1 - 1e-13) - position_error);
    if (c.kind == Cell::Kind::curved)  // the axis may go there and back
      way = std::min(way + 2 * c.length * range->wrong(k), c.length * range->most(k));
    c.energy[k] = 2 * acceleration_[k] * (way + 1e-13 * c.length + position_error);
    if (c.kind == Cell::Kind::curved && range->wrong(k) > 0) c.turning = static_cast<std::uint8_t>(c.turning | 1u << k);
  }
  if (c.kind == Cell::Kind::straight) return c;
  c.divisible = c.length > 1e4 * position_error;
  c.valley = valley_;
  double fastest = feeds_[a.segment];
  for (std::size_t k = 0; k < axes_; ++k)
    if (const double least = range->least(k) - a.rounding_error - b.rounding_error; least > no_direction)
      fastest = std::min(fastest, velocity_[k] / least);
  for (std::size_t k = 0; k < axes_; ++k)
    c.velocity[k] = std::min(velocity_[k], fastest * (range->most(k) + a.rounding_error + b.rounding_error));
  // The conditions p_m b_a ≤ q_m b_b + c_m and q_k b_b ≤ p_k b_a + c_k leave b_a and b_b finite where the lines cross.
  for (std::size_t k = 0; k < axes_; ++k)
    for (std::size_t m = 0; m < axes_; ++m) {
      if (m == k) continue;
      const double pk = a.most(k), qk = b.least(k), pm = a.least(m), qm = b.most(m);
      const double cross = pm * qk * (1 - 4 * epsilon) - pk * qm;
      if (!(cross > 0)) continue;
      b.cap = std::min(b.cap, (pk * c.energy[m] + pm * c.energy[k]) / cross * give);
      a.cap = std::min(a.cap, (qm * c.energy[k] + qk * c.energy[m]) / cross * give);
    }
  return c;
}

}  // namespace bahnwerk::verify
