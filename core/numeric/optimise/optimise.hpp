#pragma once
/// Minimum of a function of several variables under bounds and smooth inequalities: one search by NLopt 2.7 [Johnson:
/// The NLopt nonlinear-optimization package], of which the best point is kept.
///
/// Cost beside the callbacks: 1 µs per evaluation of a few variables; `slsqp` n³ + n² · (active rows) per iteration,
/// without a call of Progress.
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/base/progress.hpp"

namespace bahnwerk {

/// Rows c(x) ≤ 0.
struct Inequalities {
  std::size_t rows = 0;
  /// Fills `values` (rows) and, unless it is empty, `jacobian` (rows × dimension, row by row: ∂cᵢ/∂xⱼ at i · dimension
  /// + j).
  std::function<void(std::span<const double> x, std::span<double> values, std::span<double> jacobian)> evaluate;
};

/// Callbacks receive points within the bounds only. A value that is not finite means "undefined here"; the search
/// avoids such points. Only slsqp requests gradients; it ends where one is not finite. Exceptions of callbacks are
/// passed on by minimise() unchanged.
struct OptimisationProblem {
  std::size_t dimension = 0;         ///< at least 1
  std::vector<double> lower, upper;  ///< bounds of each variable; may be infinite; empty: unbounded
  std::vector<double> scale;         ///< typical size of each variable's change; empty: 1
  double objective_scale = 1;        ///< typical change of the objective when a variable changes by its scale
  /// Returns f(x) and fills `gradient` (dimension) unless it is empty.
  std::function<double(std::span<const double> x, std::span<double> gradient)> objective;
  Inequalities inequality;
};

/// The algorithms of NLopt that are offered.
enum class OptimisationMethod {
  slsqp,   ///< sequential quadratic programming [Kraft 1988]; gradients, up to a few hundred variables
  cobyla,  ///< linear models on a simplex [Powell 1994]; no gradients, up to about 20 variables
};

/// Tolerances are in units of the scales. Results depend on problem, start and options only.
struct OptimisationOptions {
  OptimisationMethod method = OptimisationMethod::slsqp;
  /// A search ends when it moves by less, relative to x and to the scales. For cobyla 1e-5 is suitable; with less it
  /// may alternate between two points until max_evaluations.
  double step_tolerance = 1e-9;
  double constraint_tolerance = 1e-8;  ///< largest violation of a feasible point
  std::size_t max_evaluations = 10000;
};

/// The feasible point with the least objective that was evaluated, else the point with the least violation. Nothing
/// confirms that it is a minimum.
struct OptimisationResult {
  std::vector<double> x;                                        ///< within the bounds; empty: no value was finite
  double objective = std::numeric_limits<double>::quiet_NaN();  ///< f(x)
  double violation = std::numeric_limits<double>::quiet_NaN();  ///< largest c(x), 0 where all are negative
  std::size_t evaluations = 0;                                  ///< points at which the callbacks ran
};

/// `start` is moved into the bounds. Calls progress.report("optimise", …) before every evaluation. Throws
/// std::invalid_argument for sizes that do not match.
OptimisationResult minimise(const OptimisationProblem& problem, std::span<const double> start,
                            const OptimisationOptions& options, Progress progress);

}  // namespace bahnwerk
