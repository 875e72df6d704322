#pragma once
/// The law of one section of a path, from rest to rest, planned by itself.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// `plan` is given the segments [first, last) of a Cartesian path alone, their feeds, and rests at both ends; places
/// and segments of what it returns become those of the whole path. Throws Infeasible where a segment cannot be planned
/// by itself, and what `plan` throws.
TimeLaw section_law(const AxisPath& path, std::size_t first, std::size_t last, const Machine& machine,
                    const std::vector<double>& feeds, const std::function<TimeLaw(const PathTask&)>& plan);

}  // namespace bahnwerk
