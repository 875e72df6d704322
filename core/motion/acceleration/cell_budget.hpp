#pragma once
/// Memory of the acceleration-limited planner: the number of cells that a path needs, and wider cells for paths that
/// need more than usual.
///
/// A cell takes about 270 bytes of its window and 72 for its law. A curved segment has one cell, and one more per
/// `options.grid.angle` that it turns, times a density that is measured on some of the segments. Wider cells lose
/// accuracy; the planner's loss of duration and the verified margin below the limits contain the cost.
#include <vector>

#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/grid/lane_path.hpp"

namespace bahnwerk {

class ProgressScope;

/// Quantities that determine the number of cells: the number of curved segments, and their turn in rad.
struct CurvedParts {
  double curved = 0, turn = 0;
  /// Returns the number of cells that turn by `angle` (rad), at density 1.
  double count(double angle) const { return curved + turn / angle; }
};

/// The cells that a path needs.
struct CellBudget {
  std::vector<CurvedParts> segments;   ///< curved parts of each segment; zeros for a straight one
  CurvedParts all;                     ///< sum of `segments`
  double density = 1;                  ///< cells per counted cell: 1, more where curvature changes fast
  AccelerationLimitedOptions options;  ///< the options with cells that are wide enough
  /// Relative excess over limits that the model of a cell may hide: 0 for cells of the usual width. The law stays below
  /// the limits by it, since verifying a law once more costs more than such a margin.
  double model_error = 0;

  /// Returns the number of cells of segment i, at least 1.
  double cells(std::size_t i) const;
  /// Returns the number of cells of the whole path.
  double cells() const;
};

/// Counts the cells and chooses their width: `options` times a factor of `options.width` at least and 10 at most, such
/// that the path has `options.usual_cells`. `lanes` are the limits of the path's lanes, `feeds` the largest speed per
/// segment, mm/s. O(segments). Throws InvalidInput (at "contour") for a path that turns by more than 160 000 rad.
template <int N>
CellBudget cell_budget(const LanePath<N>& path, const Machine& lanes, const std::vector<double>& feeds,
                       const AccelerationLimitedOptions& options, ProgressScope& progress);

extern template CellBudget cell_budget<2>(const LanePath<2>&, const Machine&, const std::vector<double>&,
                                          const AccelerationLimitedOptions&, ProgressScope&);
extern template CellBudget cell_budget<3>(const LanePath<3>&, const Machine&, const std::vector<double>&,
                                          const AccelerationLimitedOptions&, ProgressScope&);
extern template CellBudget cell_budget<5>(const LanePath<5>&, const Machine&, const std::vector<double>&,
                                          const AccelerationLimitedOptions&, ProgressScope&);
extern template CellBudget cell_budget<8>(const LanePath<8>&, const Machine&, const std::vector<double>&,
                                          const AccelerationLimitedOptions&, ProgressScope&);

}  // namespace bahnwerk
