#include "core/probe/tighter.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::probe {

namespace {

/// Along a way of `length` mm: braking takes half of it.
double unreachable_along(const ProbeProblem& problem, double length) {
  double a = 0, j = 0, s = 0;
  for (std::size_t k = 0; k < problem.dimension(); ++k) {
    a = std::hypot(a, problem.axis(k).acceleration);
    j = std::hypot(j, problem.axis(k).jerk);
    s = std::hypot(s, problem.axis(k).snap);
  }
  return std::min({std::sqrt(a * length), std::cbrt(j * length * length), std::sqrt(std::sqrt(s * length) * length)});
}

double polyline_length(const ProbeProblem& problem) {
  double length = 0;
  for (std::size_t i = 0; i < problem.edges(); ++i) length += norm(problem.points[i + 1] - problem.points[i]);
  return length;
}

}  // namespace

double unreachable_speed(const ProbeProblem& problem) {
  const double around = 2 * problem.tolerance * static_cast<double>(problem.edges());
  return unreachable_along(problem, polyline_length(problem) + around);
}

std::vector<ProbeProblem> with_tighter(const ProbeProblem& problem) {
  constexpr std::size_t many = 300;  // points: from here on a search is not worth its time
  const bool few = problem.points.size() <= 100;
  std::vector<ProbeProblem> list{problem};
  const double speed = std::min(problem.speed, unreachable_speed(problem));
  const double highest = unreachable_along(problem, polyline_length(problem));
  list[0].speed = speed;
  if (problem.points.size() > many) return list;
  const auto add = [&](double v, double tolerance, double jerk, double snap) {
    ProbeProblem p = problem;
    p.speed = v, p.tolerance *= tolerance;
    for (AxisLimits& axis : p.machine.axes) axis.jerk *= jerk, axis.snap *= snap;
    list.push_back(std::move(p));
  };
  add(0.95 * speed, 1, 1, 1);
  add(0.85 * speed, 1, 1, 1);
  const int per_octave = few ? 3 : 2, lower = few ? 9 : 4;
  const int first = static_cast<int>(std::floor(per_octave * std::log2(std::max(1.0, highest / speed)))) + 1;
  for (int i = first; i < first + lower; ++i) add(highest * std::exp2(-static_cast<double>(i) / per_octave), 1, 1, 1);
  constexpr double less = 0.8;
  add(speed, less, 1, 1);
  add(speed, 1, less, 1);
  add(speed, 1, 1, less);
  return list;
}

}  // namespace bahnwerk::probe
