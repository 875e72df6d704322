#pragma once
/// Which part of a document the motion drives when: the path's segments with their times.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// A path segment in the time of the setpoints, or a dwell, which has no length. They follow one another without gaps.
struct DrivenSegment {
  std::size_t source = 0;  ///< line of a program, or number of the segment in the document
  std::size_t block = 0;
  Mode mode = Mode::cut;
  double start = 0, time = 0;  ///< s
  double length = 0;           ///< mm
  double feed = 0;             ///< mm/s; infinite: limited by the axes alone
  double least_time = 0;       ///< s: at the feed all along; without one, at the velocity that the axes have along it
  bool rests = false;          ///< whether the motion rests at its begin, or all along
};

/// Returns the segments of the contour that the law drives. `axes` follow it, with the limits of `machine`; `law` is
/// that of the setpoints. O(pieces + segments), and
/// eight evaluations of the path per curve without a feed; asks `progress` every 4096 pieces.
std::vector<DrivenSegment> driven_segments(const Contour& contour, const AxisPath& axes, const Machine& machine,
                                           const TimeLaw& law, Progress progress);

/// Returns the segments of a contour that is not planned, in their order: without times, rests and dwells.
std::vector<DrivenSegment> document_segments(const Contour& contour, const AxisPath& axes, const Machine& machine,
                                             Progress progress);

}  // namespace bahnwerk
