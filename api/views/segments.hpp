#pragma once
/// The view `segments`: which part of the document the motion drives when. It is made from the plan or, for a job of an
/// older version, from the document and the columns s, v and block of the rows: blocks begin and end within a cycle of
/// the true time, segments within a block by their lengths, and a dwell belongs to the segment after it.
#include <cstdint>
#include <memory>
#include <vector>

#include "api/views/views.hpp"

namespace bahnwerk::api {

/// A segment of the driven path, or a dwell.
struct PlannedSegment {
  std::uint32_t source = 0;  ///< line of a program from 1, else number of the segment in the document from 0
  std::uint32_t block = 0;
  bool cut = false;
  bool rests = false;          ///< whether the motion rests at its begin, or all along
  double start = 0, time = 0;  ///< s
  double length = 0;           ///< mm
  double feed = 0;             ///< mm/s; infinite: none
  double least_time = 0;       ///< s, at the feed all along; without one, at the axes' velocities
};

struct SegmentTable {
  std::vector<PlannedSegment> segments;  ///< segments in the order of time, without gaps
  bool program = false;                  ///< whether sources are lines of a program
};

/// Makes the view; nullptr if the facts have no segments, or the series lacks a column that is needed.
std::unique_ptr<View> segment_view(const ViewInput& input, const ViewSink& sink);
/// Returns the table as it was stored: times and lengths in single precision, the begins in double. nullopt: there is
/// no such view. 10 ns per segment.
std::optional<SegmentTable> read_segments(const ViewReader& read);

}  // namespace bahnwerk::api
