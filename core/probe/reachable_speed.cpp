#include "core/probe/reachable_speed.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::probe {

double polyline_length(const ProbeProblem& problem) {
  double length = 0;
  for (std::size_t i = 0; i < problem.edges(); ++i) length += norm(problem.points[i + 1] - problem.points[i]);
  return length;
}

double unreachable_speed(const ProbeProblem& problem) {
  const double length = polyline_length(problem) + 2 * problem.tolerance * static_cast<double>(problem.edges());
  double a = 0, j = 0, s = 0;
  for (std::size_t k = 0; k < problem.dimension(); ++k) {
    a = std::hypot(a, problem.axis(k).acceleration);
    j = std::hypot(j, problem.axis(k).jerk);
    s = std::hypot(s, problem.axis(k).snap);
  }
  // Braking takes half of the distance.
  return std::min({std::sqrt(a * length), std::cbrt(j * length * length), std::sqrt(std::sqrt(s * length) * length)});
}

ProbeProblem with_reachable_speed(ProbeProblem problem) {
  problem.speed = std::min(problem.speed, unreachable_speed(problem));
  return problem;
}

}  // namespace bahnwerk::probe
