#pragma once
/// Crossings of the edges of one boundary, or of its parallels.
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/geometry/region/edge.hpp"

namespace bahnwerk {

/// Calls `visit(i, k, meeting)`, i < k, for every meeting of two of the edges, in an order that depends on them alone.
/// O(n log n) for edges that lie side by side as in an outline: only pairs with overlapping extents are compared, and
/// with `boxes`, one for each edge, only pairs whose boxes overlap.
void each_meeting(std::span<const Edge> edges,
                  const std::function<void(std::size_t, std::size_t, const Meeting&)>& visit,
                  std::span<const Box> boxes = {});

/// Returns two edges of a closed loop, not neighbours, that touch or cross; nothing for a simple loop.
std::optional<std::pair<std::size_t, std::size_t>> self_contact(std::span<const Edge> loop);

}  // namespace bahnwerk
