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

/// The law that setpoints sample, and how many times as fast the planned motion is. It has to outlive the object.
struct SampledLaw {
  const TimeLaw& law;
  double factor = 1;
};

/// Axes along a path, and the factor per axis from its unit to the one that is shown; empty: 1. Both have to outlive
/// the object.
struct ShownAxes {
  const AxisPath& path;
  const std::vector<double>& factors;
};

/// Adds the times of the blocks, in the sampled motion, and the sums per mode, in the planned motion.
void report_blocks(const Contour& contour, const SampledLaw& sampled, ContourPlan& plan);

/// Adds the tangent jumps of up to `corner_angle` rad, which are passed at speed. Speeds are those of the planned
/// motion.
void report_joints(const Contour& contour, std::size_t axes, const SampledLaw& sampled, double corner_angle,
                   ContourPlan& plan, Progress progress);

/// Adds the same for axes along a path that `contour` gave, with steps in the units that are shown.
void report_joints(const Contour& contour, const ShownAxes& axes, const SampledLaw& sampled, double corner_angle,
                   ContourPlan& plan, Progress progress);

/// Adds a note for every axis that a planar contour does not move, with the place at which it stands, in the unit that
/// is shown; the factors are not empty.
void note_still_axes(const ShownAxes& axes, const Machine& machine, ContourPlan& plan);

/// Adds a note for every axis that a planar contour does not move.
void note_still_axes(const Contour& contour, const Machine& machine, ContourPlan& plan);

}  // namespace bahnwerk
