#pragma once
/// The time law of one section of a path, from rest to rest, planned separately from the rest of the path.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Calls `plan` with the segments [first, last) of a Cartesian path, their feeds (mm/s) and rests at both ends, and
/// returns its time law with path lengths and segment indices of the whole path. Throws Infeasible where a segment
/// cannot be planned separately, and what `plan` throws.
TimeLaw section_law(const AxisPath& path, std::size_t first, std::size_t last, const Machine& machine,
                    const std::vector<double>& feeds, const std::function<TimeLaw(const PathTask&)>& plan);

}  // namespace bahnwerk
