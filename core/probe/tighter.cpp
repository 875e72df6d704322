#include "core/probe/tighter.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::probe {

namespace {

/// Returns a speed, mm/s, that no motion along a way of `length` mm reaches: braking takes half of it.
double unreachable_along(const ProbeProblem& problem, double length) {
  double a = 0, j = 0, s = 0;
  for (std::size_t k = 0; k < problem.dimension(); ++k) {
    a = std::hypot(a, problem.axis(k).acceleration);
    j = std::hypot(j, problem.axis(k).jerk);
    s = std::hypot(s, problem.axis(k).snap);
  }
  return std::min({std::sqrt(a * length), std::cbrt(j * length * length), std::sqrt(std::sqrt(s * length) * length)});
}

constexpr std::size_t few = 100, many = 300;  // points: more problems up to there; none from there on

/// The first of the shares of `most`, 2^(−i/n), that is below `value`.
int steps_below(double value, double most, int n) {
  return static_cast<int>(std::floor(n * std::log2(std::max(1.0, most / value)))) + 1;
}
double share(int i, int n) { return std::exp2(-static_cast<double>(i) / n); }

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

ProbeProblem with_reachable_speed(ProbeProblem problem) {
  problem.speed = std::min(problem.speed, unreachable_speed(problem));
  return problem;
}

std::vector<ProbeProblem> slower_problems(const ProbeProblem& problem, double duration) {
  std::vector<ProbeProblem> list;
  if (problem.points.size() > many) return list;
  const auto add = [&](double speed) {
    list.push_back(problem);
    list.back().speed = speed;
  };
  add(0.95 * problem.speed);
  add(0.85 * problem.speed);
  const double length = polyline_length(problem), highest = unreachable_along(problem, length);
  // No motion through the points is quicker at a lower speed.
  const double lowest = length / duration;
  const int per_octave = problem.points.size() <= few ? 3 : 2;
  for (int i = steps_below(problem.speed, highest, per_octave); highest * share(i, per_octave) > lowest; ++i)
    add(highest * share(i, per_octave));
  return list;
}

std::vector<ProbeProblem> weaker_problems(const ProbeProblem& problem) {
  std::vector<ProbeProblem> list;
  if (problem.points.size() > many) return list;
  if (problem.tolerance > 0) {
    const double length = polyline_length(problem);
    const int widest = steps_below(problem.tolerance, length, 2), count = problem.points.size() <= few ? 4 : 2;
    for (int i = widest; i < widest + count; ++i) {
      list.push_back(problem);
      list.back().tolerance = length * share(i, 2);
    }
  }
  constexpr double less = 0.8;
  for (const TightenedQuantity quantity :
       {TightenedQuantity::acceleration, TightenedQuantity::jerk, TightenedQuantity::snap}) {
    list.push_back(problem);
    scale_quantity(list.back(), quantity, less, problem);
  }
  // Every axis has the limits of the weakest one: a stronger one changes nothing.
  AxisLimits weakest = problem.axis(0);
  for (const AxisLimits& axis : problem.machine.axes) {
    weakest.acceleration = std::min(weakest.acceleration, axis.acceleration);
    weakest.jerk = std::min(weakest.jerk, axis.jerk);
    weakest.snap = std::min(weakest.snap, axis.snap);
  }
  list.push_back(problem);
  for (AxisLimits& axis : list.back().machine.axes)
    axis.acceleration = weakest.acceleration, axis.jerk = weakest.jerk, axis.snap = weakest.snap;
  return list;
}

bool scale_quantity(ProbeProblem& problem, TightenedQuantity quantity, double factor, const ProbeProblem& given) {
  bool changed = false;
  const auto scale = [&](double& value, double most) {
    const double scaled = std::min(most, factor * value);
    changed = changed || scaled != value;
    value = scaled;
  };
  switch (quantity) {
    case TightenedQuantity::speed:
      scale(problem.speed, given.speed);
      return changed;
    case TightenedQuantity::tolerance:
      scale(problem.tolerance, given.tolerance);
      return changed;
    default:
      break;
  }
  for (std::size_t k = 0; k < problem.dimension(); ++k) {
    AxisLimits& axis = problem.machine.axes[k];
    const AxisLimits& most = given.axis(k);
    if (quantity == TightenedQuantity::acceleration) scale(axis.acceleration, most.acceleration);
    if (quantity == TightenedQuantity::jerk) scale(axis.jerk, most.jerk);
    if (quantity == TightenedQuantity::snap) scale(axis.snap, most.snap);
  }
  return changed;
}

}  // namespace bahnwerk::probe
