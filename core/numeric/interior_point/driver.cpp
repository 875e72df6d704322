#include "core/numeric/interior_point/driver.hpp"

#include <cmath>

namespace bahnwerk {
namespace {

/// After so many steps as short as this the iterate counts as stuck at the boundary.
constexpr double stuck_length = 0.05;
constexpr int stuck_steps = 3;

}  // namespace

InteriorPointResult run_interior_point(InteriorPointProblem& problem, const InteriorPointRule& rule, double mu) {
  InteriorPointResult result;
  int stuck = 0;
  for (;; ++result.iterations) {
    if (rule.tick) rule.tick();
    const InteriorPointFigures now = problem.evaluate(mu);
    result.gap = now.complementarity / now.scale;
    result.primal_residual = now.primal_residual;
    if (!std::isfinite(result.gap) || !std::isfinite(result.primal_residual)) break;
    result.converged = result.gap <= rule.gap && result.primal_residual <= rule.primal_residual &&
                       problem.dual_residual() <= rule.dual_residual;
    if (result.converged || now.enough || result.iterations >= rule.max_iterations || !problem.factor()) break;
    const double mean = now.complementarity / now.weight, least = rule.least_mu * rule.gap * now.scale / now.weight;
    const std::optional<double> left = problem.predict();
    if (left) mu = std::max(*left * *left * *left * mean, least);
    const StepLengths taken = problem.step(mu);
    const double length = std::min(taken.primal, taken.dual);
    if (!std::isfinite(taken.primal + taken.dual)) break;
    if (left) continue;
    const double after = (1 - length) * now.complementarity / now.weight + length * mu;
    mu = std::max(after * mu_factor(length), least);
    stuck = length < stuck_length ? stuck + 1 : 0;
    if (stuck < stuck_steps) continue;
    mu = std::clamp(10 * after, 1e-3, 0.1);
    problem.restart(mu);
    stuck = 0;
  }
  return result;
}

}  // namespace bahnwerk
