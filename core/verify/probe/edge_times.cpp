#include "core/verify/probe/edge_times.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {

double least_time(const ProbeProblem& problem, Vec displacement, Rests rests, double shorter) {
  double least = std::max(0.0, norm(displacement) - shorter) / problem.speed;
  if (rests.begin || rests.end) {
    const bool both = rests.begin && rests.end;
    for (std::size_t k = 0; k < problem.dimension(); ++k) {
      const double d = std::max(0.0, std::abs(displacement[k]) - shorter);
      const AxisLimits& axis = problem.axis(k);
      // A polynomial of degree r with leading coefficient L/r! deviates from 0 to d = L T^r / c.
      least = std::max(least, std::sqrt((both ? 4 : 2) * d / axis.acceleration));
      least = std::max(least, std::cbrt((both ? 32 : 6) * d / axis.jerk));
      least = std::max(least, std::pow((both ? 384 : 24) * d / axis.snap, 0.25));
    }
  }
  return least * (1 - 1e-12);
}

}  // namespace bahnwerk
