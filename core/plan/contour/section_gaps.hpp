#pragma once
/// Gaps of sections: how far the time of each section between two rests is above its own bound. A small gap of the
/// whole motion may hide a section with a large one.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"

namespace bahnwerk {

class AxisPath;
class TimeLaw;
struct SectionBound;

struct SectionGap {
  std::size_t source = 0;  ///< source of its first segment
  double length = 0;       ///< mm
  double time = 0;         ///< s, planned time without dwells
  double bound = 0;        ///< s
  double gap = 0;          ///< time / bound − 1
};

struct SectionGaps {
  static constexpr double shortest = 1;  ///< mm: only longer sections count
  std::size_t count = 0;
  double median = 0;  ///< median of the gaps; the smaller one of two middle values
  SectionGap worst;   ///< section with the largest gap, the first of equal ones; undefined if count is 0
};

/// Returns the planned times of the sections, s, without dwells; `law` and `factor` as below. O(pieces + sections).
std::vector<double> section_times(const TimeLaw& law, double factor, const std::vector<SectionBound>& sections);

/// Returns the gaps. `law` may contain dwells; `factor` is its duration over the planned one. `each`, if given,
/// receives the sections that count, in order. O(pieces + sections).
SectionGaps section_gaps(const AxisPath& path, const TimeLaw& law, double factor,
                         const std::vector<SectionBound>& bounds, Progress progress,
                         std::vector<SectionGap>* each = nullptr);

}  // namespace bahnwerk
