#include "core/redundant/known/timed_path.hpp"

#include <algorithm>
#include <utility>

#include "core/geometry/curve/line.hpp"

namespace bahnwerk {

namespace {
constexpr double shortest = 1e-11;  // s: shorter intervals are left out
}

std::vector<TimedPath::SmoothInterval> TimedPath::smooth_intervals(const Motion& head, const Motion& coarse) {
  std::vector<SmoothInterval> list;
  std::size_t h = 0, c = 0;
  for (double t = 0; h < head.pieces() && c < coarse.pieces();) {
    const double head_end = head.end(h), coarse_end = coarse.end(c), end = std::min(head_end, coarse_end);
    if (end - t > shortest) {
      list.push_back({t, end, h, c});
      t = end;
    }
    if (coarse_end <= end) ++c;
    if (head_end <= end) ++h;
  }
  return list;
}

Path TimedPath::tool_path(const std::vector<SmoothInterval>& intervals) {
  Path path;
  for (std::size_t i = 0; i < intervals.size(); ++i)
    path.append(std::make_shared<const Line>(Vec{per_second * intervals[i].begin, 0, 0},
                                             Vec{per_second * intervals[i].end, 0, 0}),
                i);
  return path;
}

TimedPath::TimedPath(const Path& tool, const Motion& head, const Motion& coarse, std::vector<SmoothInterval> intervals)
    : AxisPath(borrowed(tool), 2 * coarse.axes(), false),
      head_(head),
      coarse_(coarse),
      intervals_(std::move(intervals)) {}

AxisJet TimedPath::at_time(std::size_t segment, double t) const {
  const SmoothInterval& interval = intervals_[segment];
  t = std::clamp(t, interval.begin, interval.end);
  const MotionState x = head_.in_piece(interval.head, t), c = coarse_.in_piece(interval.coarse, t);
  constexpr double w = 1 / per_second;
  AxisJet q;
  const std::size_t n = coarse_.axes();
  for (std::size_t k = 0; k < n; ++k) {
    q.value[k] = c[0][k], q.d1[k] = w * c[1][k], q.d2[k] = w * w * c[2][k];
    q.d3[k] = w * w * w * c[3][k];
    q.value[n + k] = x[0][k] - c[0][k], q.d1[n + k] = w * (x[1][k] - c[1][k]);
    q.d2[n + k] = w * w * (x[2][k] - c[2][k]), q.d3[n + k] = w * w * w * (x[3][k] - c[3][k]);
  }
  return q;
}

AxisJet TimedPath::at_parameter(std::size_t segment, double u) const {
  const SmoothInterval& interval = intervals_[segment];
  return at_time(segment, interval.begin + u * (interval.end - interval.begin));
}

void TimedPath::at_parameters(std::size_t segment, PathBatch& batch) const {
  tool()[segment].at_parameters(batch);
  batch.planar = false;
  for (std::size_t i = 0; i < 2 * batch.used_pairs(); ++i) write_row(batch, i, at_parameter(segment, batch.u[i]));
}

}  // namespace bahnwerk
