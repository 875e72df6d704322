#pragma once
/// The loop of the primal–dual interior-point methods whose iterates may still violate their equations: the choice of
/// μ, stopping, and restarts. The problem keeps its unknowns, its slacks s > 0 and its multipliers z > 0 in the layout
/// that suits it, and assembles and solves Newton's system for its equations and s z = μ.
///
/// A problem with a predictor tells how much of Σ s z a step towards s z = 0 leaves, and μ becomes the cube of that
/// part of the present mean [Mehrotra, On the implementation of a primal-dual interior point method, SIAM J. Optim. 2,
/// 1992]. Without a predictor, which costs a second solution, μ follows from the length of the step before.
#include <algorithm>
#include <functional>
#include <optional>

namespace bahnwerk {

/// Part of the distance to the nearest bound that a step takes.
inline constexpr double to_boundary = 0.995;
/// Returns the longest step, at most 1, that takes no more than `part` of the distance to the nearest bound. `reach` is
/// the largest −change/value of the numbers that stay positive.
inline double step_length(double reach, double part = to_boundary) { return part / std::max(part, reach); }

/// Returns the factor by which μ falls after a step of this length: the shorter it was, the less.
inline double mu_factor(double length) { return std::clamp((1 - length) * (1 - length), 0.1, 0.8); }

/// The lengths of a step for unknowns and slacks, and for multipliers, in (0, 1]; means where they vary.
struct StepLengths {
  double primal = 1, dual = 1;
};

/// The figures of an iterate.
struct InteriorPointFigures {
  double scale = 1;            ///< positive number to which the complementarity is relative
  double complementarity = 0;  ///< Σ s z
  double weight = 1;           ///< sum of the rows' weights; s z aims at μ times the row's weight
  double primal_residual = 0;  ///< largest violation of rows and equalities
  bool enough = false;         ///< whether the iterate serves the problem's purpose whatever the figures are
};

/// A problem at its iterate.
class InteriorPointProblem {
 public:
  virtual ~InteriorPointProblem() = default;
  /// Computes the figures of the iterate. `mu`: the next step's, if there is no predictor.
  virtual InteriorPointFigures evaluate(double mu) = 0;
  /// Returns the dual residual of the iterate; asked only where all other figures suffice.
  virtual double dual_residual() = 0;
  /// Factors the matrix of the next step. Returns false if it is singular.
  virtual bool factor() = 0;
  /// Computes the step towards s z = 0. Returns the part of Σ s z that is left at its lengths; none: no predictor.
  virtual std::optional<double> predict() { return std::nullopt; }
  /// Computes the step towards s z = mu, corrected by the products of the predictor's steps, and goes it, at the latest
  /// in the next evaluate(). Returns its lengths; not finite where there is no step.
  virtual StepLengths step(double mu) = 0;
  /// Goes the last step and balances slacks and multipliers again, with s z ≈ mu.
  virtual void restart(double /*mu*/) {}
};

/// When the method ends.
struct InteriorPointRule {
  double gap = 1e-9;              ///< Σ s z relative to the scale
  double primal_residual = 1e-9;  ///< in the problem's units; programs are scaled to the order of 1
  double dual_residual = 1e-9;
  /// Part of what the gap needs that μ keeps: products far below it only increase residuals.
  double least_mu = 0.1;
  int max_iterations = 80;
  std::function<void()> tick;  ///< callback of every iteration; may throw
};

/// The outcome: figures of the last iterate.
struct InteriorPointResult {
  bool converged = false;
  int iterations = 0;
  double gap = 0, primal_residual = 0;
};

/// Iterates from the problem's iterate to the optimum. `mu`: the first one, if there is no predictor.
InteriorPointResult run_interior_point(InteriorPointProblem& problem, const InteriorPointRule& rule, double mu = 0);

}  // namespace bahnwerk
