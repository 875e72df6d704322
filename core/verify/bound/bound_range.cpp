// Enclosures of q' between two nodes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/curve/arc.hpp"
#include "core/verify/bound/bound_grid.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Hodograph::Bends bends_of(const Arc& arc) {
  const double turn = std::abs(arc.sweep()) / arc.length() * (1 + 8 * epsilon);  // rad/mm
  const double bend = arc.radius() * turn * turn;                                // 1/mm
  return {bend, bend * turn};
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
    range.low[k] = g.low - a.blur, range.high[k] = g.high + a.blur;
  }
  return range;
}

template <int N>
DirectionRange<N> BoundGrid<N>::range_by_map(const Node& a, const Node& b) const {
  const double length = b.s - a.s;
  const MapSizes sizes = map_sizes(a.segment, a.u, b.u, length);
  DirectionRange<N> range;
  for (std::size_t k = 0; k < axes_; ++k) {
    range.low[k] = -sizes.first[k], range.high[k] = sizes.first[k];
    if (!std::isfinite(sizes.third[k])) continue;
    const Interval g = between(a.tangent[k], b.tangent[k], a.curvature[k], b.curvature[k], length, sizes.third[k]);
    range.low[k] = std::max(range.low[k], g.low - std::max(a.blur, b.blur));
    range.high[k] = std::min(range.high[k], g.high + std::max(a.blur, b.blur));
  }
  return range;
}

// q' = Dq h', q'' = D²q[h', h'] + Dq h'', q''' = D³q[h', h', h'] + 3 D²q[h', h''] + Dq h''', h being the tool's pose.
template <int N>
typename BoundGrid<N>::MapSizes BoundGrid<N>::map_sizes(std::size_t segment, double u0, double u1, double length,
                                                        int depth) const {
  const double half = (u1 - u0) / 2, middle = u0 + half, turn = path_.pose_turn(segment, middle, half);
  const MapBounds map = path_.map_bounds(segment, middle, turn > 0 ? std::hypot(length, turn) : length);
  const Hodograph::Bends bends = this->bends(segment, u0, u1);
  const PoseSizes pose = pose_sizes(segment, u0, u1, turn, bends);
  MapSizes sizes;
  bool known = true;
  for (std::size_t k = 0; k < axes_; ++k) {
    const double m1 = scale_[k] * map.order[0][k], m2 = scale_[k] * map.order[1][k], m3 = scale_[k] * map.order[2][k];
    sizes.first[k] = m1 * pose.first;
    sizes.third[k] = m3 * pose.first * pose.first * pose.first + 3 * m2 * pose.first * pose.second + m1 * pose.third;
    known = known && std::isfinite(sizes.first[k]) && (std::isfinite(sizes.third[k]) || !std::isfinite(bends.third));
  }
  if (known || depth == 0 || !(middle > u0 && middle < u1)) return sizes;
  const double before = path_[segment].travelled(middle) - path_[segment].travelled(u0);  // smaller balls may do
  const MapSizes left = map_sizes(segment, u0, middle, before, depth - 1),
                 right = map_sizes(segment, middle, u1, std::max(length - before, 0.0), depth - 1);
  for (std::size_t k = 0; k < axes_; ++k) {
    sizes.first[k] = std::max(left.first[k], right.first[k]);
    sizes.third[k] = std::max(left.third[k], right.third[k]);
  }
  return sizes;
}

// Angles by Cauchy's estimates on discs of twice the size or more: the smallest bounds that one of them gives.
template <int N>
typename BoundGrid<N>::PoseSizes BoundGrid<N>::pose_sizes(std::size_t segment, double u0, double u1, double turn,
                                                          const Hodograph::Bends& bends) const {
  if (turn == 0) return {1, bends.second, bends.third};
  if (!discs_ || discs_of_ != segment) discs_.emplace(path_[segment].curve()), discs_of_ = segment;
  const double half = (u1 - u0) / 2;
  CurveDisc disc = discs_->about(u0 + half);
  disc.first = 1, disc.second = bends.second, disc.third = bends.third;  // better known on the real axis
  constexpr double none = std::numeric_limits<double>::infinity();
  PoseSizes least{none, none, none};
  for (int i = 0; i < 6 && disc.radius >= 2 * half; ++i, disc.radius /= 2) {
    const CurveDisc pose = with_turn(disc, path_.pose_turn(segment, disc.centre, disc.radius));
    if (pose.third < least.third || i == 0) least = {pose.first, pose.second, pose.third};
  }
  return least;
}

// Of the tool's path: |h''| and |h'''|.
template <int N>
Hodograph::Bends BoundGrid<N>::bends(std::size_t index, double u0, double u1) const {
  const Segment& segment = path_[index];
  if ((segment.cusp_begin() && u0 <= segment.curve().begin()) || (segment.cusp_end() && u1 >= segment.curve().end()))
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  if (segment.straight()) return {};
  return segment.curve().kind() == CurveKind::arc ? bends_of(static_cast<const Arc&>(segment.curve()))
                                                  : hodograph(index).bends(u0, u1);
}

template <int N>
std::array<double, N> BoundGrid<N>::third(const Node& a, const Node& b) const {
  Row third{};
  if (shape(a.segment).linear) return third;
  if (path_.cartesian()) {
    third.fill(bends(a.segment, a.u, b.u).third);
    return third;
  }
  return map_sizes(a.segment, a.u, b.u, b.s - a.s).third;
}

template Hodograph::Bends BoundGrid<2>::bends(std::size_t, double, double) const;
template BoundGrid<2>::MapSizes BoundGrid<2>::map_sizes(std::size_t, double, double, double, int) const;
template BoundGrid<2>::PoseSizes BoundGrid<2>::pose_sizes(std::size_t, double, double, double,
                                                          const Hodograph::Bends&) const;
template Hodograph& BoundGrid<2>::hodograph(std::size_t) const;
template Hodograph::Bends BoundGrid<3>::bends(std::size_t, double, double) const;
template BoundGrid<3>::MapSizes BoundGrid<3>::map_sizes(std::size_t, double, double, double, int) const;
template BoundGrid<3>::PoseSizes BoundGrid<3>::pose_sizes(std::size_t, double, double, double,
                                                          const Hodograph::Bends&) const;
template Hodograph& BoundGrid<3>::hodograph(std::size_t) const;
template Hodograph::Bends BoundGrid<8>::bends(std::size_t, double, double) const;
template BoundGrid<8>::MapSizes BoundGrid<8>::map_sizes(std::size_t, double, double, double, int) const;
template BoundGrid<8>::PoseSizes BoundGrid<8>::pose_sizes(std::size_t, double, double, double,
                                                          const Hodograph::Bends&) const;
template Hodograph& BoundGrid<8>::hodograph(std::size_t) const;
template DirectionRange<2> BoundGrid<2>::range(const Node&, const Node&) const;
template DirectionRange<3> BoundGrid<3>::range(const Node&, const Node&) const;
template DirectionRange<8> BoundGrid<8>::range(const Node&, const Node&) const;
template DirectionRange<2> BoundGrid<2>::range_by_map(const Node&, const Node&) const;
template DirectionRange<3> BoundGrid<3>::range_by_map(const Node&, const Node&) const;
template DirectionRange<8> BoundGrid<8>::range_by_map(const Node&, const Node&) const;
template std::array<double, 2> BoundGrid<2>::third(const Node&, const Node&) const;
template std::array<double, 3> BoundGrid<3>::third(const Node&, const Node&) const;
template std::array<double, 8> BoundGrid<8>::third(const Node&, const Node&) const;

}  // namespace bahnwerk::verify
