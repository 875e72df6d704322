#include "core/winding/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bahnwerk::winding {
namespace {

constexpr double touch = 1e-9;  // mm

struct Extent {
  Point low, high;
  std::size_t edge = 0;
};

Extent extent(const Edge& edge, std::size_t index) {
  // An arc reaches over its chord by its rise at most, or is part of its circle.
  const bool wide = std::abs(edge.turn) > std::numbers::pi;
  const double rise = edge.straight() ? 0 : wide ? 2 * edge.radius : edge.radius * (1 - std::cos(edge.turn / 2));
  const Point a = edge.from, b = edge.to, more{rise + touch, rise + touch};
  return {Point{std::min(a.x, b.x), std::min(a.y, b.y)} - more, Point{std::max(a.x, b.x), std::max(a.y, b.y)} + more,
          index};
}

/// Calls `visit(i, k)`, i < k, for edges whose extents overlap, until it returns false.
template <class Visit>
void each_close_pair(std::span<const Edge> edges, Visit visit) {
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < edges.size(); ++i) extents.push_back(extent(edges[i], i));
  std::sort(extents.begin(), extents.end(), [](const Extent& a, const Extent& b) {
    return a.low.x < b.low.x || (a.low.x == b.low.x && a.edge < b.edge);
  });
  for (std::size_t i = 0; i < extents.size(); ++i)
    for (std::size_t k = i + 1; k < extents.size() && extents[k].low.x <= extents[i].high.x; ++k) {
      if (extents[k].low.y > extents[i].high.y || extents[i].low.y > extents[k].high.y) continue;
      const auto [first, second] = std::minmax(extents[i].edge, extents[k].edge);
      if (!visit(first, second)) return;
    }
}

bool touches(const Edge& a, const Edge& b) {
  if (!meetings(a, b).empty()) return true;
  const auto on = [](const Edge& edge, Point p) { return distance(edge.at(edge.nearest(p)), p) < touch; };
  return on(a, b.from) || on(a, b.to) || on(b, a.from) || on(b, a.to);
}

}  // namespace

void each_meeting(std::span<const Edge> edges,
                  const std::function<void(std::size_t, std::size_t, const Meeting&)>& visit) {
  each_close_pair(edges, [&](std::size_t i, std::size_t k) {
    for (const Meeting& meeting : meetings(edges[i], edges[k])) visit(i, k, meeting);
    return true;
  });
}

std::optional<std::pair<std::size_t, std::size_t>> self_contact(std::span<const Edge> loop) {
  std::optional<std::pair<std::size_t, std::size_t>> found;
  const std::size_t n = loop.size();
  each_close_pair(loop, [&](std::size_t i, std::size_t k) {
    const bool neighbours = k == i + 1 || (i == 0 && k + 1 == n);
    if (!neighbours && touches(loop[i], loop[k])) found = {i, k};
    return !found;
  });
  return found;
}

}  // namespace bahnwerk::winding
