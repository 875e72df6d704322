#include "core/verify/geometry/frechet.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::verify {

namespace {

constexpr std::size_t cells_per_report = 1000;

/// Part [low, high] of an edge, 0 … 1; empty by default.
struct Part {
  double low = 1, high = 0;
  bool empty() const { return !(low <= high); }
};

/// Returns the part of the edge from q0 to q1 within r of p.
Part near_part(Vec p, Vec q0, Vec q1, double r) {
  const Vec way = q1 - q0, off = p - q0;
  const double length = norm(way);
  if (!(length > 0)) return norm(off) <= r ? Part{0, 1} : Part{};
  const Vec along = way / length;
  const double foot = dot(off, along), aside = norm(off - foot * along);
  if (!(aside <= r)) return {};
  const double half = std::sqrt((r - aside) * (r + aside));
  const Part part{std::max(0.0, (foot - half) / length), std::min(1.0, (foot + half) / length)};
  return part.high < 0 || part.low > 1 ? Part{} : part;
}

/// The reachable part of edge `edge` of b from one point of a.
struct Reached {
  std::size_t edge = 0;
  Part part;
};

}  // namespace

Traversal traverse_within(const std::vector<Vec>& a, const std::vector<Vec>& b, double radius, std::size_t max_cells,
                          ProgressScope& progress) {
  if (a.size() < 2 || b.size() < 2 || !(norm(a.front() - b.front()) <= radius) ||
      !(norm(a.back() - b.back()) <= radius))
    return Traversal::impossible;
  std::vector<Reached> now, next;
  // From a's first point b is reachable as far as it stays near without a gap.
  for (std::size_t j = 0; j + 1 < b.size(); ++j) {
    const Part part = near_part(a[0], b[j], b[j + 1], radius);
    if (part.empty() || part.low > 0) break;
    now.push_back({j, part});
    if (part.high < 1) break;
  }
  bool waiting = true;  // b's first point is near all of a so far
  std::size_t cells = 0, told = 0;
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    next.clear();
    Part below;
    if (waiting) {
      below = near_part(b[0], a[i], a[i + 1], radius);
      if (below.low > 0) below = {};
      waiting = below.high >= 1;
    }
    std::size_t k = 0;
    for (std::size_t j = 0; j + 1 < b.size(); ++j) {
      if (below.empty()) {
        if (k == now.size()) break;
        j = now[k].edge;
      }
      Part left;
      if (k < now.size() && now[k].edge == j) left = now[k++].part;
      Part right = near_part(a[i + 1], b[j], b[j + 1], radius);
      if (below.empty()) right.low = std::max(right.low, left.low);
      if (!right.empty()) next.push_back({j, right});
      Part above = near_part(b[j + 1], a[i], a[i + 1], radius);
      if (left.empty()) above.low = std::max(above.low, below.low);
      below = above;
      if (++cells - told >= cells_per_report) {
        progress.work(cells - told);
        told = cells;
        if (cells > max_cells) return Traversal::too_long;
      }
    }
    std::swap(now, next);
    if (now.empty() && !waiting) return Traversal::impossible;
  }
  const bool arrived = !now.empty() && now.back().edge + 2 == b.size() && now.back().part.high >= 1;
  return arrived ? Traversal::possible : Traversal::impossible;
}

}  // namespace bahnwerk::verify
