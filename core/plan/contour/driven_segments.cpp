#include "core/plan/contour/driven_segments.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/motion/law/block_times.hpp"
#include "core/motion/law/dwell.hpp"

namespace bahnwerk {
namespace {

/// Returns the time per length at which no axis is faster than it may be, s/mm.
double least_pace(const AxisArray& tangent, const Machine& machine, std::size_t axes) {
  double pace = 0;
  for (std::size_t k = 0; k < axes; ++k)
    if (std::isfinite(machine.axes[k].velocity)) pace = std::max(pace, std::abs(tangent[k]) / machine.axes[k].velocity);
  return pace;
}

double time_at_axis_velocity(const AxisPath& path, std::size_t index, const Machine& machine) {
  const Segment& segment = path[index];
  const std::size_t axes = std::min(path.axes(), machine.dimension());
  if (path.linear(index))
    return segment.length() * least_pace(path.at_parameter(index, segment.curve().begin()).d1, machine, axes);
  constexpr int parts = 8;  // midpoints of equal lengths
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double s = segment.s0() + segment.length() * (i + 0.5) / parts;
    sum += least_pace(path.at(index, s).d1, machine, axes);
  }
  return sum / parts * segment.length();
}

/// Sets length and least time of a segment of a block, whose feed is known.
void measure(const AxisPath& path, std::size_t i, const Machine& machine, DrivenSegment& out) {
  out.length = path[i].length();
  out.least_time = std::isfinite(out.feed) ? out.length / out.feed : time_at_axis_velocity(path, i, machine);
}

DrivenSegment begin_segment(const Contour& contour, std::size_t segment, std::size_t block) {
  DrivenSegment out;
  out.source = contour.path[segment].source();
  out.block = block;
  out.mode = contour.blocks[block].mode;
  out.feed = contour.blocks[block].feed;
  return out;
}

}  // namespace

std::vector<DrivenSegment> document_segments(const Contour& contour, const AxisPath& axes, const Machine& machine,
                                             Progress progress) {
  std::vector<DrivenSegment> out;
  out.reserve(contour.path.size());
  for (std::size_t b = 0; b < contour.blocks.size(); ++b)
    for (std::size_t i = contour.blocks[b].first; i < contour.blocks[b].last; ++i) {
      if (i % 4096 == 0) progress.report("report", 1);
      out.push_back(begin_segment(contour, i, b));
      measure(axes, i, machine, out.back());
    }
  return out;
}

std::vector<DrivenSegment> driven_segments(const Contour& contour, const AxisPath& axes, const Machine& machine,
                                           const TimeLaw& law, Progress progress) {
  const std::vector<BlockTime> blocks = block_times(contour, law);
  std::vector<DrivenSegment> out;
  out.reserve(contour.path.size() + contour.rests.size());
  std::size_t block = 0, last = static_cast<std::size_t>(-1), done = 0;  // last segment, unless a dwell
  bool dwelt = false;
  for (const LawPiece& piece : law.pieces()) {
    if (done++ % 4096 == 0) progress.report("report", 1);
    while (block + 1 < blocks.size() && piece.t0 >= blocks[block].end) ++block;
    const bool dwell = dwells(piece), rests = !(piece.v > 0);
    if (!out.empty() && dwell == dwelt && (dwell ? out.back().block == block : piece.segment == last)) {
      out.back().time += piece.duration;
      continue;
    }
    DrivenSegment next = begin_segment(contour, piece.segment, block);
    next.start = piece.t0, next.time = piece.duration;
    next.rests = rests;
    // A segment that goes on after a dwell has its length already.
    if (!dwell && piece.segment != last) measure(axes, piece.segment, machine, next);
    if (!dwell) last = piece.segment;
    dwelt = dwell;
    out.push_back(next);
  }
  return out;
}

}  // namespace bahnwerk
