#pragma once
/// The scene of a contour on coarse and fine axes in space: its lines, the head, the range of the fine axes.
#include "api/scene.hpp"
#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/redundant/coarse_fine.hpp"

namespace bahnwerk::api::contour {

/// Returns the scene in the base frame, with at most max_scene_vertices vertices.
Scene contour_scene(const Contour& contour, const CoarseFineMachine& machine, Progress progress);

}  // namespace bahnwerk::api::contour
