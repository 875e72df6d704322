#pragma once
/// Drawings of the axes of a plan with coarse and fine axes.
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/curve/vec.hpp"
#include "core/plan/coarse_fine/coarse_fine_plan.hpp"

namespace bahnwerk {

/// Returns an SVG below 200 kB with, per moving axis over time, the positions of head and coarse axis, the position of
/// the fine axis within its stroke, and velocities and accelerations of both with their limits [as Bock, Figs. 4.6 to
/// 4.9]. Curves show the least and largest values, at ends and middles of the motion's cells, in each of 360 columns. A
/// limit far from the values reached is not drawn. O(cells).
std::string axis_drawing(const CoarseFinePlan& plan, const CoarseFineMachine& machine, Progress progress);

/// Returns the path of the coarse axes, mm, at the ends of their cells.
std::vector<Vec> coarse_way(const CoarseFinePlan& plan);

}  // namespace bahnwerk
