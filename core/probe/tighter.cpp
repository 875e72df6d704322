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
  struct Shares {
    double acceleration = 1, jerk = 1, snap = 1;
  };
  const auto add = [&](double v, double tolerance, Shares of) {
    ProbeProblem p = problem;
    p.speed = v, p.tolerance = tolerance;
    for (AxisLimits& axis : p.machine.axes)
      axis.acceleration *= of.acceleration, axis.jerk *= of.jerk, axis.snap *= of.snap;
    list.push_back(std::move(p));
  };
  const double tolerance = problem.tolerance;
  add(0.95 * speed, tolerance, {});
  add(0.85 * speed, tolerance, {});
  const int per_octave = few ? 3 : 2, lower = few ? 9 : 4;
  // Shares 2^(−i/n) of `most`, the largest ones below `value`.
  const auto steps_below = [](double value, double most, int n) {
    return static_cast<int>(std::floor(n * std::log2(std::max(1.0, most / value)))) + 1;
  };
  const auto share = [](int i, int n) { return std::exp2(-static_cast<double>(i) / n); };
  // The lowest one does not rise with the speed, so that a higher speed loses none of them.
  const int first = steps_below(speed, highest, per_octave), least = few ? 13 : 0;
  for (int i = first; i < std::max(first + lower, least); ++i) add(highest * share(i, per_octave), tolerance, {});
  if (tolerance > 0) {
    const double length = polyline_length(problem);
    const int widest = steps_below(tolerance, length, 2);
    for (int i = widest; i < widest + (few ? 4 : 2); ++i) add(speed, length * share(i, 2), {});
  }
  constexpr double less = 0.8;
  add(speed, tolerance, {less, 1, 1});
  add(speed, tolerance, {1, less, 1});
  add(speed, tolerance, {1, 1, less});
  // Every axis as the weakest one: what a stronger one adds changes nothing.
  AxisLimits weakest = problem.axis(0);
  for (const AxisLimits& axis : problem.machine.axes) {
    weakest.acceleration = std::min(weakest.acceleration, axis.acceleration);
    weakest.jerk = std::min(weakest.jerk, axis.jerk);
    weakest.snap = std::min(weakest.snap, axis.snap);
  }
  add(speed, tolerance, {});
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
