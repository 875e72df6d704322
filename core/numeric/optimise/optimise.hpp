#pragma once
/// Minimum of a function of several variables under bounds and smooth constraints: a facade over NLopt 2.7 [Johnson:
/// The NLopt nonlinear-optimization package] that verifies NLopt's result.
///
/// Cost beside the callbacks: 1 µs per evaluation of a few variables; `slsqp` n³ + n² · (active rows) per iteration,
/// without a call of Progress: 10 ms at 200 variables and 200 rows (the longest one 0.1 s), 70 ms at 400 and
/// 400 (0.5 s); `mma` up to 10 ms. Measured by tests/bench/bench_optimise.cpp.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/base/progress.hpp"

namespace bahnwerk {

/// Rows c(x) ≤ 0, or c(x) = 0.
struct Constraints {
  std::size_t rows = 0;
  /// Fills `values` (rows) and, unless it is empty, `jacobian` (rows × dimension, row by row: ∂cᵢ/∂xⱼ at i · dimension
  /// + j).
  std::function<void(std::span<const double> x, std::span<double> values, std::span<double> jacobian)> evaluate;
  /// Change of each row that is equivalent to 1 in another row; empty: 1. Violations are in this unit.
  std::vector<double> scale;
};

/// Callbacks receive points within the bounds only. A value that is not finite means "undefined here"; the search
/// avoids such points. Only slsqp and mma request gradients; an entry that is not set counts as undefined. Exceptions
/// of callbacks are passed on by minimise() unchanged.
struct OptimisationProblem {
  std::size_t dimension = 0;
  std::vector<double> lower, upper;  ///< bounds of each variable; may be infinite; empty: unbounded
  std::vector<double> scale;         ///< typical size of each variable's change; empty: 1
  double objective_scale = 1;        ///< typical change of the objective when a variable changes by its scale
  /// Returns f(x) and fills `gradient` (dimension) unless it is empty.
  std::function<double(std::span<const double> x, std::span<double> gradient)> objective;
  Constraints inequality;  ///< c(x) ≤ 0
  Constraints equality;    ///< c(x) = 0
};

/// The algorithms of NLopt that are offered.
enum class OptimisationMethod {
  slsqp,   ///< sequential quadratic programming [Kraft 1988]; gradients, any constraints, up to a few hundred variables
  mma,     ///< method of moving asymptotes [Svanberg 2002]; gradients, inequalities, slower and more robust than slsqp
  cobyla,  ///< linear models on a simplex [Powell 1994]; no gradients, any constraints, up to about 20 variables
  isres,   ///< evolution strategy [Runarsson, Yao 2005]; global, finite bounds, any constraints, no gradients; uses the
           ///< seed
  direct_l,  ///< dividing rectangles [Gablonsky, Kelley 2001]; global, finite bounds, no constraints, no gradients
};

/// Tolerances are in units of the scales. Results depend on problem, start and options only: equal seeds give equal
/// bits.
struct OptimisationOptions {
  OptimisationMethod method = OptimisationMethod::slsqp;
  /// A search ends when it moves by less, relative to x and to the scales. For cobyla 1e-5 is suitable; with less it
  /// may alternate between two points until max_evaluations.
  double step_tolerance = 1e-9;
  double kkt_tolerance = 1e-6;         ///< largest kkt_residual of a solution
  double constraint_tolerance = 1e-8;  ///< largest violation of a feasible point
  std::size_t max_evaluations = 10000;
  std::uint64_t seed = 1;  ///< seed of isres and of the starting points of repeated searches
};

/// Reason for which a search ended.
enum class OptimisationStatus {
  /// slsqp, mma: the point is feasible and its KKT residual within its tolerance: a local minimum to first order.
  converged,
  /// cobyla, isres, direct_l: the method ended at a feasible point; nothing confirms the minimum.
  search_ended,
  /// No feasible point was found; with slsqp and mma the largest violation has a confirmed local minimum above the
  /// tolerance.
  infeasible,
  /// max_evaluations was reached (up to three more are made to check the end); x is the best point found.
  evaluation_limit,
  /// slsqp, mma: the KKT residual stayed above its tolerance in all repeated searches; x is the best point found.
  stalled,
  /// There was no point with finite values, or gradients were not finite at all starts.
  undefined,
};

/// The best point found.
struct OptimisationResult {
  OptimisationStatus status = OptimisationStatus::undefined;
  std::vector<double> x;                                        ///< solution within the bounds
  double objective = std::numeric_limits<double>::quiet_NaN();  ///< f(x)
  double violation = std::numeric_limits<double>::quiet_NaN();  ///< largest violation of a row, in its scale
  /// slsqp, mma: the least ‖∇f + Jᵀλ‖∞ and |λᵢcᵢ| over multipliers of the right sign, scaled, relative to max(1,
  /// ‖∇f‖∞); with status `infeasible` that of the problem "smallest largest violation". NaN if there is none.
  double kkt_residual = std::numeric_limits<double>::quiet_NaN();
  std::size_t evaluations = 0;  ///< points at which the callbacks ran, repeated searches included
};

/// `start` is moved into the bounds. Calls progress.report("optimise", …) before every evaluation. slsqp and mma are
/// repeated from their end with tighter tolerances, then from points nearby, until the KKT conditions hold; without a
/// feasible point the largest violation is minimised first. Throws std::invalid_argument for sizes that do not match,
/// scales that are not positive, a start or bounds that are NaN, and for a method that does not apply to the problem
/// (mma with equalities, direct_l with constraints, isres and direct_l without finite bounds).
OptimisationResult minimise(const OptimisationProblem& problem, std::span<const double> start,
                            const OptimisationOptions& options, Progress progress);

}  // namespace bahnwerk
