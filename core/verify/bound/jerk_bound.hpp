#pragma once
/// How long a section takes at least when jerk is limited: by duality, from the nodes of the bound without jerk.
///
/// The dual function (core/verify/bound/jerk_dual.hpp) turns any multipliers into a bound; those of the convex problem
/// in core/motion/relaxation come close to the best. That solver is a source of numbers only: nothing that it does can
/// make the bound wrong.
///
/// Through kinematics the relaxation also takes what jerk leaves of the axes' accelerations
/// (core/verify/bound/jerk_ways.hpp), and the dual function counts it.
///
/// Several pieces of the path (core/verify/bound/jerk_pieces.hpp) make a cell of the relaxation.
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
#include "core/verify/bound/jerk_ways.hpp"

namespace bahnwerk::verify {

/// N axes as the BoundGrid has them.
template <int N>
class JerkBound {
 public:
  using Row = std::array<double, N>;
  JerkBound(const BoundGrid<N>& grid, const Machine& machine, ProgressScope& pulse);

  /// Whether any axis limits jerk at all.
  bool limited() const { return limited_; }
  /// Of the first nodes of the grid at hand, s. `b`: the largest v² that a motion may have at each of them; `time`:
  /// what the way between them takes without limits of jerk, about. 0 where jerk cannot show. O(nodes): 2 to 4 µs per
  /// cell of two axes, three times that on sections of up to 1000 cells, which are done once more on finer ones.
  double duration(const std::vector<double>& b, double time, bool rest_first, bool rest_last);
  /// Of all relaxations so far.
  std::size_t cells() const { return cells_; }

 private:
  /// Of the pieces at hand.
  double whole(bool rest_first, bool rest_last);
  /// Of the pieces at hand as far as anything is known of jerk, window by window; drops them.
  double stretch(bool rest_first, bool rest_last);
  /// Pieces become cells, `most` of them at most. False: there are no more of which anything is known.
  bool pose(std::size_t most);
  /// Those before cell `first` are not needed any more.
  void forget(std::size_t first);

  /// A set of multipliers and what it proves: one for all limits, one without those that cells are too wide to show.
  /// These may keep the solver from good multipliers.
  struct Attempt {
    Row jerk{};
    RelaxationWindows<N> solver;
    double total = 0;
  };

  const BoundGrid<N>& grid_;
  ProgressScope& pulse_;
  bool limited_ = false;
  std::size_t cells_ = 0;
  Row shown_jerk_{};                                       ///< per axis: what cells are narrow enough for
  double ramp_ = std::numeric_limits<double>::infinity();  ///< s, shortest time from no acceleration to the limit
  double acceleration_of_ramp_ = 0;                        ///< of that axis
  std::vector<std::size_t> cell_of_;                       ///< per piece at hand
  /// Of the cell that is being made up: s; rad; integral of the caps; of the axes' acceleration.
  double time_ = 0, turn_ = 0, capped_ = 0, swing_ = 0;
  double slowest_ = 0, fastest_ = 0;  ///< of its pieces: caps
  std::vector<JerkWays<N>> ways_;     ///< per cell at hand, through kinematics
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
