#pragma once
/// Planning tasks for the coarse axes alone: their limits, whether their ranges suffice, and where the tool has to rest
/// because coarse axes cannot follow a jump of a derivative.
#include <cstddef>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/redundant/joint/joint_task.hpp"

namespace bahnwerk {

/// Returns `share` (0 … 1) of the coarse axes' own limits as a machine with the machine's axis names.
Machine coarse_machine(const CoarseFineMachine& machine, double share);

/// Returns `rests` (one entry per segment: rest at its begin) with additional rests wherever first or second
/// derivatives of the axes jump between segments. A jump counts if it exceeds what rounding of the segments' points can
/// cause: with size = distance from zero + length + an arc's diameter that is 32 ε size (1/length + curvature) for the
/// first derivative and (1/length + curvature) times as much for the second.
std::vector<bool> rests_at_jumps(const AxisPath& path, std::vector<bool> rests);

/// Returns the indices of the axes whose coordinate of the tool's path leaves the range that within_coarse_range()
/// checks.
std::vector<std::size_t> beyond_coarse_range(const AxisPath& path, const CoarseFineMachine& machine, double part = 0);
/// Tells whether the tool's path stays within the coarse axes' ranges, widened by `part` of the strokes; with `part` =
/// 0 the coarse axes can do the whole motion alone. Curved segments are sampled at 32 places.
bool within_coarse_range(const AxisPath& path, const CoarseFineMachine& machine, double part = 0);

/// Returns the task without fine axes: the coarse axes are ordinary axes of a machine, which take the small jumps of
/// derivatives that their accelerations and jerks allow in a cycle.
JointTask without_fine_axes(JointTask task);

}  // namespace bahnwerk
