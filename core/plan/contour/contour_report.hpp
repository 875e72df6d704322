#pragma once
/// Parts of the report that all plans of contours have, whatever their axes are.
#include <cstddef>

#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/plan/contour_plan.hpp"

namespace bahnwerk {

class Progress;

/// Adds the times of the blocks, in the sampled motion, and the sums per mode, in the planned motion, which is shorter
/// by `factor`.
void report_blocks(const Contour& contour, const TimeLaw& sampled, double factor, ContourPlan& plan);

/// Adds the tangent jumps that are passed at speed. Speeds are those of the planned motion: `factor` times the sampled
/// ones.
void report_joints(const Contour& contour, std::size_t axes, const TimeLaw& sampled, double factor, double corner_angle,
                   ContourPlan& plan, Progress& progress, double progress_at);

/// Adds a note for every axis that a planar contour does not move.
void note_still_axes(const Contour& contour, const Machine& machine, ContourPlan& plan);

}  // namespace bahnwerk
