#include "core/verify/bound/bound_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/verify/bound/bound_cell.ipp"
#include "core/verify/bound/bound_range.ipp"
#include "core/verify/bound/bound_width.ipp"

namespace bahnwerk::verify {
namespace {

constexpr int deepest = 40;
// Cells in which q'_k may have the wrong sign by more than this are halved, so often at most.
constexpr double undecided = 1e-6;
constexpr int halvings = 12;

}  // namespace

template <int N>
BoundGrid<N>::BoundGrid(const AxisPath& path, const Machine& machine, std::vector<double> feeds, double corner_angle,
                        ProgressScope& progress)
    : path_(path),
      axes_(path.axes()),
      cycle_time_(machine.cycle_time),
      corner_angle_(corner_angle),
      feeds_(std::move(feeds)),
      progress_(progress) {
  scale_.fill(1);
  if (!path.cartesian()) scale_axes();
  for (std::size_t k = 0; k < axes_; ++k) {
    acceleration_[k] = machine.axes[k].acceleration * scale_[k];
    velocity_[k] = machine.axes[k].velocity * scale_[k];
    jerk_[k] = machine.axes[k].jerk * scale_[k];
    jerk_limited_ = jerk_limited_ || (std::isfinite(jerk_[k]) && !path.cartesian());
  }
  for (double& f : feeds_)
    if (!(f > 0)) f = unlimited;
}

// The scale of small jerk effects is 1; nothing else depends on it, so samples suffice.
template <int N>
void BoundGrid<N>::scale_axes() {
  const AxisArray most = largest_rates(path_, &progress_);
  for (std::size_t k = 0; k < axes_; ++k) still_[k] = most[k] == 0;
  for (std::size_t k = 0; k < axes_; ++k)
    if (most[k] > 0 && std::isfinite(most[k])) scale_[k] = std::exp2(-std::ceil(std::log2(most[k])));
}

template <int N>
void BoundGrid<N>::append_segment(std::size_t index) {
  const Segment& segment = path_[index];
  const Shape known = shape(index);
  const double u0 = known.first, u1 = known.last;
  Node last = node(index, u0);
  valley_ = unlimited;
  append(last);
  if (known.linear) return append(node(index, u1));
  if (known.rational == nullptr) {
    const double sweep = known.arc != nullptr ? std::abs(known.arc->sweep()) : 0;
    const int n = std::max(path_.cartesian() ? 1 : 8, static_cast<int>(std::ceil(sweep / widest_turn)));
    for (int i = 1; i <= n; ++i) {
      const Node next = node(index, i == n ? u1 : u0 + (u1 - u0) * i / n);
      path_.cartesian() ? append_with_roots(last, next, 0) : append_between(last, next, 0);
      last = next;
    }
    return;
  }
  for (const double u : segment.panel_parameters()) {
    if (!(u > last.u)) continue;
    const Node next = node(index, u);
    append_between(last, next, 0);
    last = next;
  }
}

template <int N>
void BoundGrid<N>::append_between(const Node& a, const Node& b, int depth) {
  const double u = a.u + (b.u - a.u) / 2;
  valley_ = unlimited;
  // Next to a cusp nothing but rounding is left to be resolved.
  if (depth >= deepest || !(u > a.u && u < b.u) || !(b.s - a.s > rounding_of(path_length(b))))
    return append_with_roots(a, b, 0);
  Node middle = place(a.segment, u);
  if (!too_wide(a, b) && !changes(a, middle, b)) {
    valley_ = valley(a, middle, b);
    return append_with_roots(a, b, 0);
  }
  complete(middle);
  append_between(a, middle, depth + 1);
  append_between(middle, b, depth + 1);
}

// A node wherever a component of the tangent changes sign from a to b.
template <int N>
void BoundGrid<N>::append_with_roots(const Node& a, const Node& b, int axis, int depth) {
  for (std::size_t k = static_cast<std::size_t>(axis); k < axes_; ++k) {
    double flo = a.tangent[k], fhi = b.tangent[k], lo = a.u, hi = b.u;
    if (!(flo * fhi < 0) || std::max(std::abs(flo), std::abs(fhi)) < no_direction) continue;
    // Through kinematics what is 0 at a node is so but for rounding: a root right beside it would say nothing.
    if (!path_.cartesian() && std::min(std::abs(flo), std::abs(fhi)) <= a.rounding_error) continue;
    Node root;
    for (int i = 0, side = 0; i < 80; ++i) {
      double u = (lo * fhi - hi * flo) / (fhi - flo);
      if (i > 20 || !(u > lo && u < hi)) u = lo + (hi - lo) / 2;
      if (!(u > lo && u < hi)) break;
      root = node(a.segment, u);
      const double f = root.tangent[k];
      if (std::abs(f) < 2 * epsilon) break;
      if (f * flo > 0) {
        lo = u, flo = f;
        if (side < 0) fhi /= 2;
        side = -1;
      } else {
        hi = u, fhi = f;
        if (side > 0) flo /= 2;
        side = 1;
      }
    }
    if (!(root.u > a.u && root.u < b.u)) continue;
    if (!path_.cartesian() && std::min(root.s - a.s, b.s - root.s) <= rounding_of(path_length(b))) continue;
    root.tangent[k] = 0;
    append_with_roots(a, root, static_cast<int>(k) + 1, depth);
    append_with_roots(root, b, static_cast<int>(k) + 1, depth);
    return;
  }
  append_monotone(a, b, depth);
}

// Encloses the distance of every axis between the ends of the cell. Where monotonicity cannot be shown for the whole
// cell, half cells are tried; the remaining doubt is added to the cell's energy.
template <int N>
void BoundGrid<N>::append_monotone(const Node& a, const Node& b, int depth) {
  const double length = b.s - a.s;
  if (!(length > rounding_of(path_length(b)))) return append(b);
  const DirectionRange<N> all = range(a, b);
  bool doubt = false;
  for (std::size_t k = 0; k < axes_; ++k) doubt = doubt || all.wrong(k) > undecided;
  const double u = a.u + (b.u - a.u) / 2;
  if (!doubt || depth >= halvings || !(length > 1e-7 * path_[a.segment].length()) || !(u > a.u && u < b.u))
    return append(b, &all);
  const Node middle = node(a.segment, u);
  append_with_roots(a, middle, 0, depth + 1);
  append_with_roots(middle, b, 0, depth + 1);
}

template <int N>
void BoundGrid<N>::append(const Node& b, const DirectionRange<N>* range) {
  std::uint32_t id = b.id;
  if (id == Node::unknown) {
    id = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(b);
    nodes_[id].id = id;
    progress_.work(shape(b.segment).linear ? 1 : 8);
  }
  order_.push_back(id);
  if (order_.size() < 2) return;
  const std::uint32_t before = order_[order_.size() - 2];
  const Cell between = cell(nodes_[before], nodes_[id], range);
  if (before < cells_.size())
    cells_[before] = between;
  else
    cells_.push_back(between);
}

template <int N>
void BoundGrid<N>::build(std::size_t first, std::size_t last, bool rest_first, bool rest_last) {
  nodes_.clear(), cells_.clear(), order_.clear();
  for (std::size_t i = first; i < last; ++i) append_segment(i);
  cells_.push_back({});  // no cell begins at the last node; this one keeps the ids equal
  if (rest_first) nodes_[order_.front()].cap = 0;
  if (rest_last) nodes_[order_.back()].cap = 0;
  fresh_.assign(1, {0, static_cast<std::uint32_t>(order_.size() - 1)});
}

// Divides a cell into quarters.
template <int N>
void BoundGrid<N>::divide(std::uint32_t first, std::uint32_t last) {
  std::array<Node, 5> nodes;
  nodes[0] = nodes_[first];
  const bool deep = std::isfinite(cells_[first].valley);
  const Node& end = nodes_[last];
  std::size_t parts = 0;
  for (int part = 1; part <= 3; ++part)
    if (const double u = nodes[0].u + (end.u - nodes[0].u) * part / 4; u > nodes[parts].u && u < end.u)
      nodes[++parts] = node(end.segment, u);
  nodes[++parts] = end;
  for (std::size_t i = 0; i < parts; ++i) {
    const Node &a = nodes[i], &b = nodes[i + 1];
    valley_ = deep ? valley(a, place(a.segment, a.u + (b.u - a.u) / 2), b) : unlimited;
    append_with_roots(a, b, 0);
  }
}

template <int N>
void BoundGrid<N>::refine(const std::vector<unsigned char>& marked) {
  former_.swap(order_);
  order_.clear(), fresh_.clear();
  order_.push_back(former_.front());
  for (std::size_t i = 0; i + 1 < former_.size(); ++i) {
    if (i % 64 == 0) progress_.work(1);
    if (!marked[i] || !cells_[former_[i]].divisible) {
      order_.push_back(former_[i + 1]);
      continue;
    }
    const auto begin = static_cast<std::uint32_t>(order_.size() - 1);
    divide(former_[i], former_[i + 1]);
    const auto end = static_cast<std::uint32_t>(order_.size() - 1);
    if (!fresh_.empty() && fresh_.back().last == begin)
      fresh_.back().last = end;
    else
      fresh_.push_back({begin, end});
  }
}

template class BoundGrid<2>;
template class BoundGrid<3>;
template class BoundGrid<5>;
template class BoundGrid<8>;

}  // namespace bahnwerk::verify
