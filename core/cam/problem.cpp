#include "core/cam/problem.hpp"

#include <algorithm>

namespace bahnwerk::cam {

int MotionLawProblem::continuity(std::size_t point) const {
  int order = points[point].continuity;
  for (int r = static_cast<int>(points[point].values.size()) - 1; r > order; --r)
    if (!points[point].value(r).free()) order = r;
  return order;
}

bool MotionLawProblem::has_free_angles() const {
  return std::any_of(points.begin(), points.end(), [](const MotionPoint& p) { return !p.at.fixed(); });
}

double MotionLawProblem::points_stroke() const {
  double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
  for (const MotionPoint& point : points) {
    highest = std::max(highest, point.value(0).min);
    lowest = std::min(lowest, point.value(0).max);
  }
  return std::max(0.0, highest - lowest);
}

std::vector<double> section_times(const MotionLawProblem& problem, const std::vector<double>& at) {
  const double scale = problem.seconds_per_unit();
  std::vector<double> times;
  for (const double angle : at) times.push_back(angle * scale);
  if (problem.periodic) times.push_back(times.front() + *problem.cycle_duration);
  return times;
}

}  // namespace bahnwerk::cam
