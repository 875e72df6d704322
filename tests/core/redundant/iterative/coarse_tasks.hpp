#pragma once
/// Samples of a head for coarse fits, and what a fit is measured by.
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/redundant/iterative/coarse_fit.hpp"

namespace bahnwerk::test {

inline CoarseTask task_of(double duration, std::size_t samples, double tolerance,
                          const std::function<double(double)>& x) {
  CoarseTask task;
  task.duration = duration;
  task.positions.resize(samples);
  for (std::size_t i = 0; i < samples; ++i) task.positions[i] = x(task.time(i));
  for (std::size_t i = 1; i < samples; ++i)
    task.speed = std::max(task.speed, std::abs(task.positions[i] - task.positions[i - 1]) / task.time(1));
  task.tolerance = tolerance;
  task.begin.position = task.positions.front();
  task.limits = {1800, 16000};
  return task;
}
/// From rest to rest over 300 mm, with a wave on it that the fine axis can follow.
inline double wave(double t) { return 150 * (1 - std::cos(M_PI * t)) + 15 * std::sin(40 * t) * std::sin(M_PI * t); }

inline double largest_error(const CoarseTask& task, const TimeSpline& s) {
  double most = 0;
  for (std::size_t i = 0; i < task.positions.size(); ++i)
    most = std::max(most, std::abs(s.in_piece(s.find(task.time(i), 0), task.time(i)).x - task.positions[i]));
  return most;
}
inline double energy(const TimeSpline& s) {
  double sum = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double t = s.duration() * (i + 0.5) / n, a = s.in_piece(s.find(t, 0), t).a;
    sum += a * a * s.duration() / n;
  }
  return sum;
}

/// Knots from 0 to 1 s for splines of a degree that are clamped at both ends.
inline std::vector<double> clamped(std::size_t degree, std::vector<double> inner) {
  inner.insert(inner.begin(), degree + 1, 0.0);
  inner.insert(inner.end(), degree + 1, 1.0);
  return inner;
}

}  // namespace bahnwerk::test
