#pragma once
/// Why a machine does not reach a winding: its own sizes, or the circle in which the wire bends at the needle.
#include <vector>

#include "core/base/progress.hpp"
#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk {

/// Returns the needle's path through these support points, with links by `objective`. Reports fractions 0 to 1.
Expected<winding::NeedlePath, winding::NoPath> linked_path(const WindingRequest& request,
                                                           const std::vector<winding::FixedPiece>& support,
                                                           LinkObjective objective, Progress progress);

/// Tells whether the machine reaches the turn of `piece` and its neighbours if the wire bends in the least circle that
/// it may, of its own overall diameter. Costs some ms; `turns` are those of the whole plan.
bool reaches_with_least_bend(const WindingRequest& request, const std::vector<winding::Turn>& turns,
                             const winding::FixedPiece& piece, Progress progress);

}  // namespace bahnwerk
