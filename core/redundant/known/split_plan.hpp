#pragma once
/// A time law over coarse and fine axes together, once it is settled where the coarse axes stand [Bock 3.2].
#include <memory>

#include "core/redundant/known/split_path.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Returns the fastest law within the limits of all 2 N axes; the coarse motion as polynomials in time. `coarse` keeps
/// the fine axes inside their strokes; the planner's cells are `longest_cell` mm long at most where it is not linear.
/// Cost: that of the acceleration-limited planner with twice the axes. Throws what it throws, and Infeasible if limits
/// were exceeded between the planner's stations even with 10 % less of them.
RedundancyResult plan_split(const RedundancyTask& task, const std::shared_ptr<const CoarsePath>& coarse,
                            double longest_cell, const RedundancyOptions& options, Progress& progress, double from,
                            double to);

}  // namespace bahnwerk
