#include "core/plan/contour/driven_segments.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/motion/law/block_times.hpp"
#include "core/motion/law/dwell.hpp"

namespace bahnwerk {
namespace {

/// Returns the time per length at which no axis is faster than it may be, s/mm.
double least_pace(Vec tangent, const Machine& machine, std::size_t axes) {
  double pace = 0;
  for (std::size_t k = 0; k < axes; ++k)
    if (std::isfinite(machine.axes[k].velocity)) pace = std::max(pace, std::abs(tangent[k]) / machine.axes[k].velocity);
  return pace;
}

double time_at_axis_velocity(const Segment& segment, const Machine& machine, std::size_t axes) {
  const Curve& curve = segment.curve();
  if (segment.straight()) return segment.length() * least_pace(segment.at_parameter(curve.begin()).d1, machine, axes);
  constexpr int parts = 8;  // midpoints of equal lengths
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double s = segment.s0() + segment.length() * (i + 0.5) / parts;
    sum += least_pace(segment.at(s).d1, machine, axes);
  }
  return sum / parts * segment.length();
}

}  // namespace

std::vector<DrivenSegment> driven_segments(const Contour& contour, const Machine& machine, const TimeLaw& law,
                                           Progress& progress) {
  const std::vector<BlockTime> blocks = block_times(contour, law);
  const std::size_t axes = std::min(machine.dimension(), contour.dimension);
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
    const Segment& segment = contour.path[piece.segment];
    DrivenSegment next;
    next.source = segment.source();
    next.block = block;
    next.mode = contour.blocks[block].mode;
    next.start = piece.t0, next.time = piece.duration;
    next.feed = contour.blocks[block].feed;
    next.rests = rests;
    if (!dwell && piece.segment != last) {  // a segment that goes on after a dwell has its length already
      next.length = segment.length();
      next.least_time =
          std::isfinite(next.feed) ? next.length / next.feed : time_at_axis_velocity(segment, machine, axes);
    }
    if (!dwell) last = piece.segment;
    dwelt = dwell;
    out.push_back(next);
  }
  return out;
}

}  // namespace bahnwerk
