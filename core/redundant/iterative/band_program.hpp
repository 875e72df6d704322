#pragma once
/// Convex quadratic programs whose rows have few neighbouring variables and one more variable w that all rows may
/// share:
///
///   minimise ½ yᵀQy + cᵀy + γ w   so that   lower_i − e_i w ≤ a_iᵀ y ≤ upper_i + e_i w,   w ≥ 0.
///
/// With Q = 0, γ = 1 and e = 1 the optimum w is the least largest deviation from rows with lower = upper. With a large
/// γ and e > 0 in some rows these are elastic: they are exceeded by as little as the other rows allow.
///
/// The driver of core/numeric/interior_point solves the program. The matrix of its steps is a band with one border.
/// Cost: O(rows · band²) per iteration, 10 to 40 iterations.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/numeric/linear/symmetric_band.hpp"
#include "core/redundant/iterative/spline_ends.hpp"

namespace bahnwerk {

struct BandRow {
  VariableRow row;              ///< a_i; its offset is already subtracted from lower and upper
  double lower = 0, upper = 0;  ///< finite
  double elastic = 0;           ///< e
};

struct BandProgram {
  SymmetricBand<> quadratic;  ///< Q, with the band width of the rows
  std::vector<BandRow> rows;
  std::vector<double> linear;  ///< c; empty: 0
  double price = 0;            ///< γ; 0: w does not exist
};

struct BandProgramOptions {
  double gap = 1e-5;       ///< duality gap at which iterations end, relative to 1 + the objective
  double residual = 1e-9;  ///< residual of the rows at which iterations end
  int max_iterations = 80;
  std::function<void()> tick;  ///< called every iteration; may throw
};

struct BandSolution {
  std::vector<double> y;
  double w = 0;
  int iterations = 0;
  bool converged = false;
};

/// Returns the solution; `converged` is false if iterations ended before the gap was reached. Rows should be scaled so
/// that they and their bounds have the order of 1. `start` is an arbitrary y; a start close to the solution saves
/// iterations.
BandSolution solve(const BandProgram& program, const std::vector<double>& start, const BandProgramOptions& options);

}  // namespace bahnwerk
