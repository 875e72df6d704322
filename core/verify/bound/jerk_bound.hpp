#pragma once
/// A lower bound of the duration of a section under limits of jerk, by duality, from the nodes of the bound without
/// jerk.
///
/// The dual function (core/verify/bound/jerk_dual.hpp) turns any multipliers into a bound; those of the convex problem
/// in core/motion/relaxation are close to the best. That solver only supplies numbers: none of its results can make the
/// bound wrong.
///
/// Several pieces of the path (core/verify/bound/jerk_pieces.hpp) form a cell of the relaxation.
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/relaxation/windows.hpp"
#include "core/verify/bound/bound_grid.hpp"
#include "core/verify/bound/jerk_dual.hpp"
#include "core/verify/bound/jerk_pieces.hpp"

namespace bahnwerk::verify {

/// `N` is the number of axes of the BoundGrid.
template <int N>
class JerkBound {
 public:
  using Row = std::array<double, N>;
  JerkBound(const BoundGrid<N>& grid, const Machine& machine, ProgressScope& progress);

  /// Returns whether any axis has a jerk limit.
  bool limited() const { return limited_; }
  /// Returns the bound for the first nodes of the current grid, s. `b` is the largest v² that a motion may have at each
  /// of them; `time` is the approximate duration between them without limits of jerk. Returns 0 where jerk has no
  /// visible effect. O(nodes): 2 to 4 µs per cell of two axes, three times that on sections of up to 1000 cells, which
  /// are solved again on finer ones.
  double duration(const std::vector<double>& b, double time, bool rest_first, bool rest_last);
  /// Returns the number of cells of all relaxations so far.
  std::size_t cells() const { return cells_; }

 private:
  /// Returns the bound of the current pieces, solved at once.
  double whole(bool rest_first, bool rest_last);
  /// Returns the bound of the known pieces, solved window by window, and drops them.
  double stretch(bool rest_first, bool rest_last);
  /// Forms at most `most` cells from pieces. Returns false if there are no more pieces.
  bool pose(std::size_t most);
  /// Drops the cells before cell `first`.
  void forget(std::size_t first);

  /// A set of multipliers and the bound that it proves. There are two: one for all limits, and one without the limits
  /// that cells are too wide to resolve, which may keep the solver from good multipliers.
  struct Attempt {
    Row jerk{};
    RelaxationWindows<N> solver;
    double total = 0;
  };

  const BoundGrid<N>& grid_;
  ProgressScope& progress_;
  bool limited_ = false;
  std::size_t cells_ = 0;
  Row shown_jerk_{};                                       ///< jerk that the cells resolve, one entry per axis
  double ramp_ = std::numeric_limits<double>::infinity();  ///< s, shortest time from zero acceleration to the limit
  double acceleration_of_ramp_ = 0;                        ///< acceleration limit of the axis with that ramp
  std::vector<std::size_t> cell_of_;                       ///< cell of each current piece
  /// Sums over the current cell: time, s; turn, rad; integral of the caps; change of the axes' acceleration.
  double time_ = 0, turn_ = 0, capped_ = 0, swing_ = 0;
  double slowest_ = 0, fastest_ = 0;  ///< smallest and largest cap of the current cell's pieces
  JerkPieces<N> pieces_;
  RelaxationProblem<N> problem_;
  std::vector<Attempt> attempts_;
  JerkDual<N> dual_;
};

extern template class JerkBound<2>;
extern template class JerkBound<3>;
extern template class JerkBound<5>;
extern template class JerkBound<8>;

}  // namespace bahnwerk::verify
