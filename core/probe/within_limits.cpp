#include "core/probe/within_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/probe/bezier.hpp"

namespace bahnwerk::probe {

double needed_slowing(const ProbeProblem& problem, const ProbeMotion& plan, double enough, ProgressScope& progress) {
  constexpr double resolution = 1e-10;
  const SplineMotion& motion = *plan.motion;
  const std::array<Strain, 3> strains = axis_strains(problem);
  double slowing = enough;
  for (std::size_t i = 0; i < motion.pieces(); ++i) {
    progress.work(4);
    const double duration = motion.end(i) - motion.begin(i);
    std::array<Vec, Bezier::max_points> c{};  // coefficients of the velocity
    std::size_t n = 1;
    for (std::size_t k = 0; k < motion.axes(); ++k) {
      Polynomial p;
      motion.polynomial(i, k, p);
      for (std::size_t d = 1; d < p.size(); ++d) c[d - 1][k] = static_cast<double>(d) * p[d];
      n = std::max(n, p.size() - 1);
    }
    Bezier x = bezier(c.data(), n, duration);
    const double fastest = peak_of(
        x, [&](Vec v) { return norm(v) / problem.speed; }, slowing, resolution);
    slowing = std::max(slowing, fastest);
    for (std::size_t order = 2; order <= 4; ++order) {
      x = derivative(x, duration);
      const double power = static_cast<double>(order);
      const double peak = peak_of(x, strains[order - 2], std::pow(slowing, power), resolution);
      slowing = std::max(slowing, std::pow(peak, 1 / power));
    }
  }
  return slowing;
}

ProbeMotion within_limits(const ProbeProblem& problem, ProbeMotion motion, ProgressScope& progress) {
  // A motion that is slowed by a little is rounded differently.
  constexpr double other = 1.000123, negligible = 1.5e-10;
  constexpr int rounds = 8;
  const ProbeMotion planned = motion;
  double factor = 1;
  for (int round = 0; round < rounds; ++round) {
    const ProbeMotion again = slowed(motion, other);
    const double excess = std::max(needed_slowing(problem, motion, 1, progress),
                                   other * needed_slowing(problem, again, 1 / other, progress)) -
                          1;
    if (excess <= negligible) break;
    // A power of two: problems that differ by the scale of time alone are slowed by the same factor.
    factor *= 1 + std::exp2(std::ceil(std::log2(1.5 * excess)));
    motion = slowed(planned, factor);
  }
  return motion;
}

}  // namespace bahnwerk::probe
