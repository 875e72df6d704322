#pragma once
/// What coarse axes do without fine ones: their own limits, and where the tool has to rest for them.
#include <cstddef>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/redundant/joint_task.hpp"

namespace bahnwerk {

/// Returns that part of the coarse axes' own limits; its axes are named as the machine's axes.
Machine coarse_machine(const CoarseFineMachine& machine, double share);

/// Returns `rests`, and each segment's begin at which first derivatives of the axes differ on both sides, with
/// `derivatives` 2 the second ones, too, by more than the rounding of the segments' points turns and bends them: with
/// size = distance from zero + length + 2 radii, 32 ε size (1/length + 1/radius), and (1/length + 1/radius) times that.
std::vector<bool> rests_at_jumps(const AxisPath& path, std::vector<bool> rests, int derivatives);

/// Returns the numbers of the axes along which the tool's path leaves that; see within_coarse_range().
std::vector<std::size_t> beyond_coarse_range(const AxisPath& path, const CoarseFineMachine& machine, double part = 0);
/// Tells whether the tool's path stays within the ranges of the coarse axes and that part of the strokes beyond them;
/// with 0 they can do all by themselves. Curves are looked at in 32 places each.
bool within_coarse_range(const AxisPath& path, const CoarseFineMachine& machine, double part = 0);

/// Returns the task at rest wherever derivatives jump that coarse axes have to let be continuous: the first, with
/// limited jerk the second ones, too.
JointTask resting_at_jumps(JointTask task);
/// Returns the task for the coarse axes alone, at rest there.
JointTask without_fine_axes(JointTask task);

}  // namespace bahnwerk
