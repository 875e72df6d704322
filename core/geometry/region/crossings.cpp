#include "core/geometry/region/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bahnwerk {
namespace {

constexpr double touch = 1e-9;  // mm

struct Extent {
  Point low, high;
  std::size_t edge = 0;
};

std::vector<Box> boxes_of(std::span<const Edge> edges) {
  std::vector<Box> boxes;
  for (const Edge& edge : edges) boxes.push_back(extent(edge, touch));
  return boxes;
}

/// Calls `visit(i, k)`, i < k, for boxes that overlap, until it returns false.
template <class Visit>
void each_close_pair(std::span<const Box> boxes, Visit visit) {
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < boxes.size(); ++i) extents.push_back({boxes[i].low, boxes[i].high, i});
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
                  const std::function<void(std::size_t, std::size_t, const Meeting&)>& visit,
                  std::span<const Box> boxes) {
  each_close_pair(boxes.empty() ? boxes_of(edges) : std::vector<Box>(boxes.begin(), boxes.end()),
                  [&](std::size_t i, std::size_t k) {
                    for (const Meeting& meeting : meetings(edges[i], edges[k])) visit(i, k, meeting);
                    return true;
                  });
}

std::optional<std::pair<std::size_t, std::size_t>> self_contact(std::span<const Edge> loop) {
  std::optional<std::pair<std::size_t, std::size_t>> found;
  const std::size_t n = loop.size();
  each_close_pair(boxes_of(loop), [&](std::size_t i, std::size_t k) {
    const bool neighbours = k == i + 1 || (i == 0 && k + 1 == n);
    if (!neighbours && touches(loop[i], loop[k])) found = {i, k};
    return !found;
  });
  return found;
}

}  // namespace bahnwerk
