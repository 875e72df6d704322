#include "core/redundant/known/filter_plan.hpp"

#include "core/redundant/known/filters.hpp"
#include "core/redundant/known/reference_search.hpp"

namespace bahnwerk {

Expected<RedundancyResult, NoPlan> plan_filter(const RedundancyTask& task, const RedundancyOptions& options,
                                               Progress progress) {
  const std::size_t taps = options.taps;
  FilterSearch search;
  // The rests are two samples longer than the group delay, because the spline is at rest where three control points are
  // equal.
  search.lead = search.tail = (static_cast<double>(taps - 1) / 2 + 2) * task.machine.cycle_time;
  search.filter = [&](const std::vector<double>& x, double step) {
    return filtered(x, low_pass(taps, options.cutoff, step));
  };
  return search_reference(task, options, search, progress);
}

}  // namespace bahnwerk
