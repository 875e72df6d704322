#pragma once
/// What every plan of a contour tells, whatever its axes are.
#include <cstddef>

#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/plan/contour_plan.hpp"

namespace bahnwerk {

class Progress;

/// Times of the blocks in the motion that is sampled; the sums per mode in the planned one, which is `factor` quicker.
void report_blocks(const Contour& contour, const TimeLaw& sampled, double factor, ContourPlan& plan);

/// Tangent jumps that are passed. Speeds as planned: `factor` times those that are sampled.
void report_joints(const Contour& contour, std::size_t axes, const TimeLaw& sampled, double factor, double corner_angle,
                   ContourPlan& plan, Progress& progress, double progress_at);

/// A note of every axis that a planar contour does not move.
void note_still_axes(const Contour& contour, const Machine& machine, ContourPlan& plan);

}  // namespace bahnwerk
