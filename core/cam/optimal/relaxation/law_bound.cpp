#include "core/cam/optimal/relaxation/law_bound.hpp"

#include <algorithm>
#include <queue>
#include <utility>

#include "core/cam/optimal/relaxation/relaxation.hpp"

namespace bahnwerk::cam {

AllLawsBound bound_over_angles(const LawTask& task, const KnownLaw& law, std::size_t programs, double gap,
                               Progress progress, double enough) {
  struct Box {
    double bound;
    std::vector<Range> ranges;
    bool operator<(const Box& other) const { return bound > other.bound; }
  };
  AllLawsBound result;
  const bool free = task.free_angles();
  RelaxationOptions options;
  if (free) options.cells = std::max<std::size_t>(96, 12 * task.sections());
  std::priority_queue<Box> open;
  open.push({relaxation_bound(task, task.at, law, options, progress), task.at});
  result.programs = 1;
  if (!free) {
    result.objective = std::min(open.top().bound, law.objective());
    return result;
  }
  // The bound at the law's own angles is the largest value that can come out.
  const double most = relaxation_bound(task, law.points(), law, options, progress);
  ++result.programs;
  while (!open.empty()) {
    const Box box = open.top();
    if (box.bound >= most * (1 - gap) || box.bound > enough) break;
    if (result.programs + 2 > programs) {
      result.complete = false;
      break;
    }
    open.pop();
    std::size_t widest = 0;
    for (std::size_t i = 0; i < box.ranges.size(); ++i)
      if (box.ranges[i].max - box.ranges[i].min > box.ranges[widest].max - box.ranges[widest].min) widest = i;
    const double middle = (box.ranges[widest].min + box.ranges[widest].max) / 2;
    for (const bool low : {true, false}) {
      Box half = box;
      (low ? half.ranges[widest].max : half.ranges[widest].min) = middle;
      if (!tighten(task, half.ranges)) continue;
      half.bound = std::max(box.bound, relaxation_bound(task, half.ranges, law, options, progress));
      ++result.programs;
      open.push(std::move(half));
    }
  }
  result.objective = std::min({law.objective(), most, open.empty() ? most : open.top().bound});
  return result;
}

}  // namespace bahnwerk::cam
