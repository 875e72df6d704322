#pragma once
/// How far each section between two rests is from its own bound: a gap of the whole may hide one that is far.
#include <cstddef>
#include <vector>

namespace bahnwerk {

class AxisPath;
class Progress;
class TimeLaw;
struct SectionBound;

struct SectionGap {
  std::size_t source = 0;  ///< of the first of its segments
  double length = 0;       ///< mm
  double time = 0;         ///< s, as planned, without dwells
  double bound = 0;        ///< s
  double gap = 0;          ///< time / bound − 1
};

struct SectionGaps {
  static constexpr double shortest = 1;  ///< mm: sections that count are longer
  std::size_t count = 0;
  double median = 0;  ///< of the gaps; of two in the middle the smaller one
  SectionGap worst;   ///< the first one, if there are several; meaningless if count is 0
};

/// What sections take as planned, s, without dwells. `law`, `factor`: as below. O(pieces + sections).
std::vector<double> section_times(const TimeLaw& law, double factor, const std::vector<SectionBound>& sections);

/// `law` with dwells or without; `factor`: by what it is slower than planned. `each`, if given, is filled with the
/// sections that count, in order. O(pieces + sections).
SectionGaps section_gaps(const AxisPath& path, const TimeLaw& law, double factor,
                         const std::vector<SectionBound>& bounds, Progress& progress, double progress_at,
                         std::vector<SectionGap>* each = nullptr);

}  // namespace bahnwerk
