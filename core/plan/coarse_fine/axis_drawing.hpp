#pragma once
/// Drawings of a plan with coarse and fine axes.
#include <string>
#include <vector>

#include "core/geometry/curve/vec.hpp"
#include "core/plan/coarse_fine/coarse_fine_plan.hpp"

namespace bahnwerk {

class Progress;

/// Per moving axis over time: positions of head and coarse axis, the fine axis within its stroke, velocities and
/// accelerations of both with their limits [kind of Bock, Figs. 4.6 to 4.9], as SVG below 200 kB. What is drawn are the
/// least and largest values near ends and at middles of the motion's cells in each of 360 columns; limits are drawn
/// where they are not far from what is reached. O(cells).
std::string axis_drawing(const CoarseFinePlan& plan, const CoarseFineMachine& machine, Progress& progress);

/// The way of the coarse axes: the ends of their cells, mm.
std::vector<Vec> coarse_way(const CoarseFinePlan& plan);

}  // namespace bahnwerk
