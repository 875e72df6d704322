#include "core/plan/contour/section_gaps.hpp"

#include <algorithm>

#include "core/base/progress_scope.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/verify/bound/lower_bound.hpp"

namespace bahnwerk {

std::vector<double> section_times(const TimeLaw& law, double factor, const std::vector<SectionBound>& sections) {
  std::vector<double> times;
  const auto& pieces = law.pieces();
  std::size_t i = 0;
  for (const SectionBound& section : sections) {
    double time = 0;
    for (; i < pieces.size() && pieces[i].segment < section.last; ++i)
      if (pieces[i].s_end > pieces[i].s) time += pieces[i].duration / factor;
    times.push_back(time);
  }
  return times;
}

SectionGaps section_gaps(const AxisPath& path, const TimeLaw& law, double factor,
                         const std::vector<SectionBound>& bounds, Progress progress, std::vector<SectionGap>* each) {
  ProgressScope stage_progress(progress, "report");
  SectionGaps result;
  std::vector<double> gaps;
  const std::vector<double> times = section_times(law, factor, bounds);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const SectionBound& section = bounds[i];
    SectionGap gap{path[section.first].source(), path[section.last - 1].s1() - path[section.first].s0(), times[i],
                   section.duration, 0};
    stage_progress.work(1);
    if (!(gap.length > SectionGaps::shortest && gap.bound > 0)) continue;
    gap.gap = gap.time / gap.bound - 1;
    gaps.push_back(gap.gap);
    if (each != nullptr) each->push_back(gap);
    if (gaps.size() == 1 || gap.gap > result.worst.gap) result.worst = gap;
  }
  result.count = gaps.size();
  if (gaps.empty()) return result;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>((gaps.size() - 1) / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  result.median = *middle;
  return result;
}

}  // namespace bahnwerk
