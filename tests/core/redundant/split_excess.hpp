#pragma once
/// By how much a split exceeds a limit at most, found by a sweep of what is between samples that knows nothing of the
/// planner.
#include <algorithm>
#include <cmath>

#include "core/numeric/peak.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk::test {

struct SplitExcess {
  double limits = -1;  ///< largest value over its limit, − 1: velocities, accelerations, jerks, stroke
  /// Largest steps of the coarse axes where pieces meet: mm, or s times mm/s, or s² times mm/s² with jerk. Under a fine
  /// axis that stands still it counts beyond the step that any machine's axis may take in a cycle.
  double jump = 0;
  double rest = 0;  ///< mm/s, of coarse axes at both ends
  double time = 0;  ///< s, by which head and coarse axes last differently
};

inline SplitExcess split_excess(const RedundancyTask& task, const RedundancyResult& r) {
  SplitExcess e;
  const std::size_t axes = task.machine.axes.size();
  const bool jerk = task.machine.limited_order() == 3;
  std::vector<double> limits;
  for (const CoarseFineAxis& a : task.machine.axes)
    for (const double limit : {a.coarse.velocity, a.coarse.acceleration, a.stroke, a.fine.velocity, a.fine.acceleration,
                               jerk ? a.coarse.jerk : 1, jerk ? a.fine.jerk : 1})
      limits.push_back(limit);
  constexpr std::size_t kinds = 7;
  const SumOfMotions both(r.head, r.coarse);  // for its pieces
  e.time = std::abs(r.head->duration() - r.coarse->duration());
  PeakSweep sweep(limits);
  std::size_t h = 0, c = 0;
  for (std::size_t piece = 0; piece < both.pieces(); ++piece) {
    const double begin = both.begin(piece), end = both.end(piece);
    if (!(end > begin)) continue;
    while (h + 1 < r.head->pieces() && r.head->begin(h + 1) <= begin) ++h;
    while (c + 1 < r.coarse->pieces() && r.coarse->begin(c + 1) <= begin) ++c;
    sweep.sweep(begin, end, false, piece, [&](PeakSamples& s) {
      const auto n = static_cast<std::size_t>(s.rule.points);
      for (std::size_t i = 0; i < n; ++i) {
        const double t = s.at(static_cast<int>(i));
        const MotionState x = r.head->in_piece(h, t), xc = r.coarse->in_piece(c, t);
        for (std::size_t k = 0; k < axes; ++k) {
          const double values[kinds] = {xc[1][k],
                                        xc[2][k],
                                        x[0][k] - xc[0][k],
                                        x[1][k] - xc[1][k],
                                        x[2][k] - xc[2][k],
                                        jerk ? xc[3][k] : 0,
                                        jerk ? x[3][k] - xc[3][k] : 0};
          for (std::size_t q = 0; q < kinds; ++q) s.values[(kinds * k + q) * n + i] = values[q];
        }
      }
      return true;
    });
  }
  for (std::size_t i = 0; i < limits.size(); ++i) e.limits = std::max(e.limits, sweep[i].value / limits[i] - 1);
  for (std::size_t k = 0; k < axes; ++k) {
    const double unit = std::sqrt(task.machine.axes[k].stroke / task.machine.axes[k].coarse.acceleration);
    e.rest = std::max({e.rest, std::abs(r.coarse->in_piece(0, 0)[1][k]), std::abs(r.coarse->final_state()[1][k])});
    const Limits& coarse = task.machine.axes[k].coarse;
    const bool still = sweep[kinds * k + 2].value <= 1e-8;
    const double step = still ? task.machine.cycle_time * coarse.acceleration : 0,
                 acceleration_step = still && jerk ? task.machine.cycle_time * coarse.jerk : 0;
    for (std::size_t i = 1; i < r.coarse->pieces(); ++i) {
      const double t = r.coarse->begin(i);
      const MotionState a = r.coarse->in_piece(i - 1, t), b = r.coarse->in_piece(i, t);
      e.jump = std::max({e.jump, std::abs(a[0][k] - b[0][k]), unit * (std::abs(a[1][k] - b[1][k]) - step),
                         jerk ? unit * unit * (std::abs(a[2][k] - b[2][k]) - acceleration_step) : 0.0});
    }
  }
  return e;
}

}  // namespace bahnwerk::test
