#pragma once
// Enclosures of q' between two nodes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/curve/arc.hpp"
#include "core/verify/bound/bound_grid.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double bend_rounding = 1e-9;  // relative rounding error of q'' at a node, estimated generously

Hodograph::DerivativeBounds second_derivative_bounds_of(const Arc& arc) {
  const double turn = std::abs(arc.sweep()) / arc.length() * (1 + 8 * epsilon);  // rad/mm
  const double q2 = arc.radius() * turn * turn;                                  // 1/mm
  return {q2, q2 * turn};
}

}  // namespace

template <int N>
Hodograph& BoundGrid<N>::hodograph(std::size_t segment) const {
  if (!hodograph_ || hodograph_of_ != segment) {
    hodograph_.emplace(static_cast<const Rational&>(path_[segment].curve()));
    hodograph_of_ = segment;
  }
  return *hodograph_;
}

template <int N>
DirectionRange<N> BoundGrid<N>::range(const Node& a, const Node& b) const {
  if (!path_.cartesian()) return range_by_map(a, b);
  DirectionRange<N> range;
  const Segment& segment = path_[a.segment];
  if (segment.straight()) {
    for (std::size_t k = 0; k < axes_; ++k) range.low[k] = range.high[k] = a.tangent[k];
    return range;
  }
  const Shape& known = shape(a.segment);
  if (known.rational != nullptr) {
    const Hodograph::Range r = hodograph(a.segment).range(a.u, b.u);
    for (std::size_t k = 0; k < axes_; ++k) range.low[k] = r.low[k], range.high[k] = r.high[k];
    return range;
  }
  for (std::size_t k = 0; k < axes_; ++k) {
    const Interval g = between(a.tangent[k], b.tangent[k], a.curvature[k], b.curvature[k], b.s - a.s, known.third);
    range.low[k] = g.low - a.rounding_error, range.high[k] = g.high + a.rounding_error;
  }
  return range;
}

// q' lies between its end values where q'' has one sign.
template <int N>
DirectionRange<N> BoundGrid<N>::range_by_map(const Node& a, const Node& b) const {
  const double length = b.s - a.s, rounding_error = std::max(a.rounding_error, b.rounding_error);
  const AxisSizes& sizes = axis_sizes(a, b);
  DirectionRange<N> range;
  for (std::size_t k = 0; k < axes_; ++k) {
    if (still_[k]) continue;
    Interval g{sizes.low[k], sizes.high[k]};
    if (sizes.q2_low[k] >= 0 || sizes.q2_high[k] <= 0)
      g = {std::min(a.tangent[k], b.tangent[k]), std::max(a.tangent[k], b.tangent[k])};
    else if (std::isfinite(sizes.third[k]))
      g = between(a.tangent[k], b.tangent[k], a.curvature[k], b.curvature[k], length, sizes.third[k]);
    range.low[k] = std::max(sizes.low[k], g.low - rounding_error);
    range.high[k] = std::min(sizes.high[k], g.high + rounding_error);
  }
  return range;
}

// Uses the path's own enclosures, else bounds of the map from the tool's position to the axes: q' = Dq h', q'' =
// D²q[h', h'] + Dq h'', q''' = D³q[h', h', h'] + 3 D²q[h', h''] + Dq h'''.
template <int N>
typename BoundGrid<N>::AxisSizes BoundGrid<N>::axis_sizes(std::size_t segment, double u0, double u1, double length,
                                                          int depth) const {
  const double half = (u1 - u0) / 2, middle = u0 + half;
  AxisSizes sizes;
  AxisDiscs discs;
  bool known = path_.enclose(segment, middle, half, discs);
  for (std::size_t k = 0; k < axes_ && known; ++k) {
    const double scale = scale_[k];
    sizes.low[k] = scale * discs.d1[k].low(), sizes.high[k] = scale * discs.d1[k].high();
    sizes.q2_low[k] = scale * discs.d2[k].low(), sizes.q2_high[k] = scale * discs.d2[k].high();
    if (still_[k]) continue;
    sizes.third[k] = scale * discs.d3[k].most();
    sizes.least_third[k] = scale * std::max(0.0, std::abs(discs.d3[k].centre) - discs.d3[k].radius);
  }
  if (known) return sizes;
  const Hodograph::DerivativeBounds derivative_bounds = this->derivative_bounds(segment, u0, u1);
  const MapBounds map = path_.map_bounds(segment, middle, length);
  known = path_.pose_turn(segment, middle, half) == 0;  // if not, the tool's angles move the axes, too
  for (std::size_t k = 0; k < axes_; ++k) {
    const double m1 = scale_[k] * map.order[0][k], m2 = scale_[k] * map.order[1][k], m3 = scale_[k] * map.order[2][k];
    const double first = known ? m1 : unlimited, second = known ? m2 + m1 * derivative_bounds.second : unlimited;
    sizes.low[k] = -first, sizes.high[k] = first;
    sizes.q2_low[k] = -second, sizes.q2_high[k] = second;
    sizes.third[k] = known ? m3 + 3 * m2 * derivative_bounds.second + m1 * derivative_bounds.third : unlimited;
  }
  for (std::size_t k = 0; k < axes_; ++k)
    known = known && std::isfinite(sizes.high[k]) &&
            (std::isfinite(sizes.third[k]) || !std::isfinite(derivative_bounds.third));
  if (known || depth == 0 || !(middle > u0 && middle < u1)) return sizes;
  const double before = path_[segment].travelled(middle) - path_[segment].travelled(u0);  // smaller stretches may do
  const AxisSizes left = axis_sizes(segment, u0, middle, before, depth - 1),
                  right = axis_sizes(segment, middle, u1, std::max(length - before, 0.0), depth - 1);
  for (std::size_t k = 0; k < axes_; ++k) {
    sizes.low[k] = std::min(left.low[k], right.low[k]), sizes.high[k] = std::max(left.high[k], right.high[k]);
    sizes.q2_low[k] = std::min(left.q2_low[k], right.q2_low[k]);
    sizes.q2_high[k] = std::max(left.q2_high[k], right.q2_high[k]);
    sizes.third[k] = std::max(left.third[k], right.third[k]);
    sizes.least_third[k] = std::min(left.least_third[k], right.least_third[k]);
  }
  return sizes;
}

template <int N>
const typename BoundGrid<N>::AxisSizes& BoundGrid<N>::axis_sizes(const Node& a, const Node& b) const {
  constexpr int halvings = 12;
  if (stretch_.segment != a.segment || stretch_.u0 != a.u || stretch_.u1 != b.u) {
    const bool known = whole_.segment == a.segment && whole_.u0 <= a.u && b.u <= whole_.u1;
    stretch_ = {a.segment, a.u, b.u,
                known ? within(whole_.sizes, a, b) : axis_sizes(a.segment, a.u, b.u, b.s - a.s, halvings)};
  }
  return stretch_.sizes;
}

template <int N>
void BoundGrid<N>::remember(const Node& a, const Node& b) const {
  if (!path_.cartesian()) whole_ = {a.segment, a.u, b.u, axis_sizes(a, b)};
}

// Follows from the enclosure of the whole interval and the ends of the part: q'' changes by at most |q'''| times the
// length.
template <int N>
typename BoundGrid<N>::AxisSizes BoundGrid<N>::within(const AxisSizes& whole, const Node& a, const Node& b) const {
  AxisSizes part = whole;
  const double length = b.s - a.s, rounding_error = std::max(a.rounding_error, b.rounding_error);
  for (std::size_t k = 0; k < axes_; ++k) {
    if (still_[k] || !std::isfinite(whole.third[k])) continue;
    const double middle = (a.curvature[k] + b.curvature[k]) / 2,
                 size = std::abs(a.curvature[k]) + std::abs(b.curvature[k]),
                 reach = whole.third[k] * length / 2 * (1 + 1e-12) + bend_rounding * size;
    part.q2_low[k] = std::max(part.q2_low[k], middle - reach);
    part.q2_high[k] = std::min(part.q2_high[k], middle + reach);
    const Interval g = between(a.tangent[k], b.tangent[k], a.curvature[k], b.curvature[k], length, whole.third[k]);
    part.low[k] = std::max(part.low[k], g.low - rounding_error);
    part.high[k] = std::min(part.high[k], g.high + rounding_error);
  }
  return part;
}

template <int N>
double BoundGrid<N>::jerk_cap(const Node& a, const Node& b) const {
  return jerk_limited_ && a.segment == b.segment ? jerk_cap(axis_sizes(a, b)) : unlimited;
}

// Returns |h''| and |h'''| of the tool's path.
template <int N>
Hodograph::DerivativeBounds BoundGrid<N>::derivative_bounds(std::size_t index, double u0, double u1) const {
  const Segment& segment = path_[index];
  if ((segment.cusp_begin() && u0 <= segment.curve().begin()) || (segment.cusp_end() && u1 >= segment.curve().end()))
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  if (segment.straight()) return {};
  return segment.curve().kind() == CurveKind::arc
             ? second_derivative_bounds_of(static_cast<const Arc&>(segment.curve()))
             : hodograph(index).derivative_bounds(u0, u1);
}

template <int N>
std::array<double, N> BoundGrid<N>::third(const Node& a, const Node& b) const {
  Row third{};
  if (shape(a.segment).linear) return third;
  if (path_.cartesian()) {
    third.fill(derivative_bounds(a.segment, a.u, b.u).third);
    return third;
  }
  return axis_sizes(a, b).third;
}

}  // namespace bahnwerk::verify
