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

// q' = Dq h', q'' = D²q[h', h'] + Dq h'', q''' = D³q[h', h', h'] + 3 D²q[h', h''] + Dq h'''.
template <int N>
DirectionRange<N> BoundGrid<N>::range_by_map(const Node& a, const Node& b) const {
  const Segment& segment = path_[a.segment];
  const double length = b.s - a.s;
  const MapBounds map = path_.map_bounds(segment.curve().at(a.u + (b.u - a.u) / 2).value, length);
  const Row third = third_by_map(a, b, map);
  DirectionRange<N> range;
  for (std::size_t k = 0; k < axes_; ++k) {
    const double first = scale_[k] * map.order[0][k];
    range.low[k] = -first, range.high[k] = first;
    if (!std::isfinite(third[k])) continue;
    const Interval g = between(a.tangent[k], b.tangent[k], a.curvature[k], b.curvature[k], length, third[k]);
    range.low[k] = std::max(range.low[k], g.low - std::max(a.blur, b.blur));
    range.high[k] = std::min(range.high[k], g.high + std::max(a.blur, b.blur));
  }
  return range;
}

template <int N>
std::array<double, N> BoundGrid<N>::third_by_map(const Node& a, const Node& b, const MapBounds& map) const {
  const Hodograph::Bends bends = this->bends(a, b);
  Row third{};
  for (std::size_t k = 0; k < axes_; ++k)
    third[k] = scale_[k] * (map.order[2][k] + 3 * map.order[1][k] * bends.second + map.order[0][k] * bends.third);
  return third;
}

// Of the tool's path: |h''| and |h'''|.
template <int N>
Hodograph::Bends BoundGrid<N>::bends(const Node& a, const Node& b) const {
  const Segment& segment = path_[a.segment];
  if ((segment.cusp_begin() && a.u <= segment.curve().begin()) || (segment.cusp_end() && b.u >= segment.curve().end()))
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  if (segment.straight()) return {};
  return segment.curve().kind() == CurveKind::arc ? bends_of(static_cast<const Arc&>(segment.curve()))
                                                  : hodograph(a.segment).bends(a.u, b.u);
}

template <int N>
std::array<double, N> BoundGrid<N>::third(const Node& a, const Node& b) const {
  Row third{};
  if (shape(a.segment).linear) return third;
  if (path_.cartesian()) {
    third.fill(bends(a, b).third);
    return third;
  }
  const Vec middle = path_[a.segment].curve().at(a.u + (b.u - a.u) / 2).value;
  return third_by_map(a, b, path_.map_bounds(middle, b.s - a.s));
}

template Hodograph::Bends BoundGrid<2>::bends(const Node&, const Node&) const;
template std::array<double, 2> BoundGrid<2>::third_by_map(const Node&, const Node&, const MapBounds&) const;
template Hodograph::Bends BoundGrid<3>::bends(const Node&, const Node&) const;
template std::array<double, 3> BoundGrid<3>::third_by_map(const Node&, const Node&, const MapBounds&) const;
template Hodograph::Bends BoundGrid<8>::bends(const Node&, const Node&) const;
template std::array<double, 8> BoundGrid<8>::third_by_map(const Node&, const Node&, const MapBounds&) const;
template Hodograph& BoundGrid<2>::hodograph(std::size_t) const;
template Hodograph& BoundGrid<3>::hodograph(std::size_t) const;
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
