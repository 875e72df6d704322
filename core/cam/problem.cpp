#include "core/cam/problem.hpp"

#include <algorithm>
#include <cmath>

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
  if (travel != 0) {
    highest = std::max(highest, points.front().value(0).min + travel);
    lowest = std::min(lowest, points.front().value(0).max + travel);
  }
  return std::max(std::abs(travel), highest - lowest);
}

Range MotionLawProblem::end_position(std::size_t section) const {
  const Range at_point = points[end_point(section)].value(0);
  const double more = travel_at_end(section);
  return {at_point.min + more, at_point.max + more};
}

PeakGroups MotionLawProblem::peak_groups() const {
  PeakGroups groups;
  std::optional<std::size_t> common;
  for (std::size_t s = 0; s < sections(); ++s) {
    const std::optional<double> own = points[s].weight;
    groups.of_section.push_back(own || !common ? groups.count() : *common);
    if (!own && common) continue;
    if (!own) common = groups.count();
    groups.weight.push_back(own.value_or(1));
  }
  return groups;
}

std::vector<double> section_times(const MotionLawProblem& problem, const std::vector<double>& at) {
  const double scale = problem.seconds_per_unit();
  std::vector<double> times;
  for (const double angle : at) times.push_back(angle * scale);
  if (problem.periodic) times.push_back(times.front() + *problem.cycle_duration);
  return times;
}

}  // namespace bahnwerk::cam
