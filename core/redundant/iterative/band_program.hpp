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

#include "core/redundant/iterative/band_matrix.hpp"

namespace bahnwerk {

struct BandRow {
  VariableRow row;              ///< its offset is part of lower and upper already
  double lower = 0, upper = 0;  ///< finite
  double elastic = 0;           ///< e
};

struct BandProgram {
  BandMatrix quadratic;  ///< Q: as wide a band as the rows have
  std::vector<BandRow> rows;
  std::vector<double> linear;  ///< c; none: 0
  double price = 0;            ///< γ; with 0 there is no w
};

struct BandProgramOptions {
  double gap = 1e-5;       ///< of the objective, relative to 1 + its value, at which it ends
  double residual = 1e-9;  ///< of the rows, in their unit
  int max_iterations = 80;
  std::function<void()> tick;  ///< called every iteration; may throw
};

struct BandSolution {
  std::vector<double> y;
  double w = 0;
  int iterations = 0;
  bool converged = false;
};

/// Rows should be scaled so that they and their bounds are of the order of 1. `start`: any y, the closer the better.
BandSolution solve(const BandProgram& program, const std::vector<double>& start, const BandProgramOptions& options);

}  // namespace bahnwerk
