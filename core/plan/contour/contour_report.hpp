#pragma once
/// Parts of the report that all plans of contours have, whatever their axes are.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/plan/contour/contour_plan.hpp"

namespace bahnwerk {

/// Adds the times of the blocks, in the sampled motion, and the sums per mode, in the planned motion, which is shorter
/// by `factor`.
void report_blocks(const Contour& contour, const TimeLaw& sampled, double factor, ContourPlan& plan);

/// Adds the tangent jumps that are passed at speed. Speeds are those of the planned motion: `factor` times the sampled
/// ones.
void report_joints(const Contour& contour, std::size_t axes, const TimeLaw& sampled, double factor, double corner_angle,
                   ContourPlan& plan, Progress progress);

/// Adds the same for axes along a path that `contour` gave, with steps in their units times `shown` (empty: 1).
void report_joints(const Contour& contour, const AxisPath& axes, const std::vector<double>& shown,
                   const TimeLaw& sampled, double factor, double corner_angle, ContourPlan& plan, Progress progress);

/// Adds a note for every axis that a planar contour does not move, with the place at which it stands, in its unit times
/// `shown`.
void note_still_axes(const AxisPath& axes, const std::vector<double>& shown, const Machine& machine, ContourPlan& plan);

/// Adds a note for every axis that a planar contour does not move.
void note_still_axes(const Contour& contour, const Machine& machine, ContourPlan& plan);

}  // namespace bahnwerk
