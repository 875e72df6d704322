#include "core/redundant/known/timed_path.hpp"

#include <algorithm>
#include <utility>

#include "core/geometry/curve/line.hpp"

namespace bahnwerk {

namespace {
constexpr double shortest = 1e-11;  // s
}

std::vector<TimedPath::Stretch> TimedPath::stretches(const Motion& head, const Motion& coarse) {
  std::vector<Stretch> list;
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

Path TimedPath::tool_path(const std::vector<Stretch>& stretches) {
  Path path;
  for (std::size_t i = 0; i < stretches.size(); ++i)
    path.append(std::make_shared<const Line>(Vec{per_second * stretches[i].begin, 0, 0},
                                             Vec{per_second * stretches[i].end, 0, 0}),
                i);
  return path;
}

TimedPath::TimedPath(const Path& tool, const Motion& head, const Motion& coarse, std::vector<Stretch> stretches)
    : AxisPath(borrowed(tool), 2 * coarse.axes(), false),
      head_(head),
      coarse_(coarse),
      stretches_(std::move(stretches)) {}

AxisJet TimedPath::at_time(std::size_t segment, double t) const {
  const Stretch& stretch = stretches_[segment];
  t = std::clamp(t, stretch.begin, stretch.end);
  const MotionState x = head_.in_piece(stretch.head, t), c = coarse_.in_piece(stretch.coarse, t);
  constexpr double w = 1 / per_second;
  AxisJet q;
  const std::size_t n = coarse_.axes();
  for (std::size_t k = 0; k < n; ++k) {
    q.value[k] = c.position[k], q.d1[k] = w * c.velocity[k], q.d2[k] = w * w * c.acceleration[k];
    q.d3[k] = w * w * w * c.jerk[k];
    q.value[n + k] = x.position[k] - c.position[k], q.d1[n + k] = w * (x.velocity[k] - c.velocity[k]);
    q.d2[n + k] = w * w * (x.acceleration[k] - c.acceleration[k]), q.d3[n + k] = w * w * w * (x.jerk[k] - c.jerk[k]);
  }
  return q;
}

AxisJet TimedPath::at_parameter(std::size_t segment, double u) const {
  const Stretch& stretch = stretches_[segment];
  return at_time(segment, stretch.begin + u * (stretch.end - stretch.begin));
}

void TimedPath::at_parameters(std::size_t segment, PathBatch& batch) const {
  tool()[segment].at_parameters(batch);
  batch.planar = false;
  for (std::size_t i = 0; i < 2 * batch.used_pairs(); ++i) write_row(batch, i, at_parameter(segment, batch.u[i]));
}

}  // namespace bahnwerk
