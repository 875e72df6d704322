#pragma once
/// A time law for coarse and fine axes together, given the coarse positions over path length [Bock 3.2].
#include <memory>

#include "core/redundant/known/split_path.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Returns the fastest time law within the limits of all 2 N axes, with the coarse motion as polynomials in time.
/// `coarse` must keep the fine axes within their strokes. Where it is not linear, the planner's cells are at most
/// `longest_cell` mm long. Cost: the acceleration-limited planner with twice the axes. Throws what that planner throws,
/// and Infeasible if limits are exceeded between its nodes even with 10 % lower limits.
Expected<RedundancyResult, NoPlan> plan_split(const RedundancyTask& task,
                                              const std::shared_ptr<const CoarsePath>& coarse, double longest_cell,
                                              const RedundancyOptions& options, Progress progress);

}  // namespace bahnwerk
