#pragma once
/// The acceleration-limited law of one window: segments between two stops, or from an entry speed to a stop.
///
/// The window gets a grid. A backward pass computes the controllable set of each node, a forward pass the largest
/// reachable v² inside these sets (core/motion/acceleration/speed_chain.hpp). Cells in which the law switches, or
/// exceeds a limit by far between its stations, are divided; then the limits of cells that exceed an acceleration are
/// reduced by a share, round by round. Only cells that a change affects are solved again.
#include <cstddef>
#include <vector>

#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/acceleration/cell_law.hpp"
#include "core/motion/acceleration/division_marks.hpp"
#include "core/motion/acceleration/flags.hpp"
#include "core/motion/acceleration/law_writer.hpp"
#include "core/motion/acceleration/speed_chain.hpp"
#include "core/motion/grid/sections.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

class ProgressScope;

/// Solves windows of one path, one after the other, in the same memory; N is the number of lanes.
template <int N>
class WindowSolver {
 public:
  /// `feed`: largest speed per segment, mm/s. `cells`: expected number of cells of the whole path. All other arguments
  /// must outlive the object.
  WindowSolver(const LanePath<N>& path, const Machine& lanes, const AccelerationLimitedOptions& options,
               const std::vector<double>& feed, const Sections& sections, double cells);
  WindowSolver(const WindowSolver&) = delete;
  WindowSolver& operator=(const WindowSolver&) = delete;

  /// Solves the segments [first, last) from v² = `entry` (mm²/s²) to a stop. Returns the number of passes over the
  /// grid. O(cells) time per pass.
  std::size_t solve(std::size_t first, std::size_t last, double entry, ProgressScope& progress);

  /// Returns whether the entry speed was low enough for a stop at the end; if not, the law is of no use.
  bool enters() const { return chain_.enters(); }
  std::size_t cells() const { return grid_.cells.size(); }  ///< number of cells of the window
  /// Returns the last segment border, as a cell, that the stop at the window's end does not influence and where the
  /// speed is determined by earlier cells, or does not change; 0 if there is none.
  std::size_t border() const;
  std::size_t segment(std::size_t c) const { return grid_.cells[c].segment; }  ///< segment of cell c
  double node(std::size_t c) const { return chain_.node(c); }                  ///< v² where cell c begins, mm²/s²
  /// Returns the largest relative excess of acceleration or of squared speed in the first `cells` cells, at least 0.
  double excess(std::size_t cells) const;
  /// Writes the law of the first `cells` cells. Cells of one segment that run at one speed become one piece.
  void write(std::size_t cells, LawWriter& law, ProgressScope& progress) const;

 private:
  double share(std::size_t c) const;
  template <class F>
  void for_all_of_cells(F&& f);
  void solve_all(double entry, ProgressScope& progress);
  void divide(ProgressScope& progress);
  void solve_dirty(ProgressScope& progress);
  double shape(std::size_t c, double v);
  void check_cell(std::size_t c);
  bool shrink_shares(ProgressScope& progress);

  const LanePath<N>& path_;
  const Machine& machine_;  // limits of the lanes
  const AccelerationLimitedOptions& options_;
  const std::vector<double>& feed_;
  AxisBounds<N> limit_;
  Grid<N> grid_;
  SpeedChain<N> chain_;
  UnsetVector<double> share_, ends_;  // share of its limits per cell; path length of its right end in its segment, mm
  UnsetVector<Excess> excess_;
  UnsetVector<CellLaw> laws_;  // laws of curved cells, before slowing
  CellFlags dirty_;            // cells whose laws change with the shares
  DivisionMarks<N> marks_;
};

extern template class WindowSolver<2>;
extern template class WindowSolver<3>;
extern template class WindowSolver<5>;
extern template class WindowSolver<8>;

}  // namespace bahnwerk
