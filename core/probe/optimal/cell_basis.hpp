#pragma once
/// A cell of the optimal probe motion: four quartic pieces of equal length, joined three times continuously
/// differentiable (a quartic spline in time whose knots are a quarter of the cell apart). It has exactly as many
/// degrees of freedom as there are states (position, velocity, acceleration, jerk) at its two ends, so the states at
/// the nodes of a chain of cells, and the durations of the cells, are the whole motion.
#include <array>
#include <cstddef>

namespace bahnwerk {

/// The rows are the Bézier points of the motion and of its derivatives over the cell's own time u ∈ [0, 1], piece by
/// piece. By the convex-hull property (Farouki 2012) a convex constraint that the rows of an order keep holds at all
/// times.
struct CellBasis {
  static constexpr std::size_t pieces = 4;
  /// Rows of order 0 … 4: positions 4·4 + 1, velocities 4·3 + 1, accelerations 4·2 + 1, jerks 4 + 1, snaps 4.
  static constexpr std::array<std::size_t, 6> first = {0, 17, 30, 39, 44, 48};
  static constexpr std::size_t rows = 48;
  /// Factors of x, v, a, j at the begin and x, v, a, j at the end (derivatives with respect to u), per row.
  double row[rows][8];
  int order[rows];
  /// The columns of a row that are not 0 lie in [from, to): points near an end depend on that end alone.
  int from[rows], to[rows];
};

/// Returns the basis, which is computed once; thread-safe.
const CellBasis& cell_basis();

}  // namespace bahnwerk
