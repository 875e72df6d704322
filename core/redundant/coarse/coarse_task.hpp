#pragma once
/// The coarse axes alone: their limits, and whether their ranges suffice.
#include <cstddef>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/redundant/coarse_fine.hpp"

namespace bahnwerk {

/// Returns `share` (0 … 1) of the coarse axes' own limits as a machine with the machine's axis names.
Machine coarse_machine(const CoarseFineMachine& machine, double share);

/// Returns the indices of the axes whose coordinate of the tool's path leaves the range that within_coarse_range()
/// checks.
std::vector<std::size_t> beyond_coarse_range(const AxisPath& path, const CoarseFineMachine& machine, double part = 0);
/// Tells whether the tool's path stays within the coarse axes' ranges, widened by `part` of the strokes; with `part` =
/// 0 the coarse axes can do the whole motion alone. Curved segments are sampled at 32 places.
bool within_coarse_range(const AxisPath& path, const CoarseFineMachine& machine, double part = 0);

}  // namespace bahnwerk
