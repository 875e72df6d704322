#pragma once
/// How long a section takes at least when jerk is limited: by duality, from the nodes of the bound without jerk.
///
/// The dual function (core/verify/bound/jerk_dual.hpp) turns any multipliers into a bound; those of the convex problem
/// in core/motion/relaxation come close to the best. That solver is a source of numbers only: nothing that it does can
/// make the bound wrong.
///
/// The path is laid out in pieces, short enough for what jerk does there: by time, by turn, by the change of
/// centripetal acceleration, finer and finer towards rests and towards joints at which an axis has to step by more
/// acceleration than one cycle allows. Several of them make a cell of the relaxation.
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/relaxation/windows.hpp"
#include "core/verify/bound/bound_grid.hpp"
#include "core/verify/bound/jerk_dual.hpp"

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
  /// what the way between them takes without limits of jerk, about. 0 where jerk cannot show. O(nodes): 2 to 5 µs per
  /// cell of two axes.
  double duration(const std::vector<double>& b, double time, bool rest_first, bool rest_last);
  /// Of all relaxations so far.
  std::size_t cells() const { return cells_; }

 private:
  using Node = BoundNode<N>;
  using Cell = BoundCell<N>;
  /// What a piece says about cells.
  struct Extent {
    double swing = 0;    ///< by how much q″_k b changes along it, over A_k
    double finest = 0;   ///< mm, longest cell here
    double spacing = 0;  ///< s, longest cell here
    double piece = 0;    ///< mm, longest piece
  };

  void expect(const std::vector<double>& b, bool rest_first, bool rest_last);
  void lay(const std::vector<double>& b, bool rest_first, bool rest_last);
  void grade(const std::vector<double>& b, bool rest_first, bool rest_last);
  double finest_at(std::size_t node, const std::vector<double>& b) const;
  Extent extent(std::size_t cell, double x, double energy, double whole, const std::vector<double>& b) const;
  std::pair<double, double> room(std::size_t cell, const std::vector<double>& b) const;
  void divide(std::size_t cell, const std::vector<double>& b);
  std::size_t joined(std::size_t first, const std::vector<double>& b);
  void append(const Node& a, const Node& b, double cap, Extent extent);
  double cap(std::size_t cell, const Node& a, const Node& b, const std::vector<double>& at_nodes, double part0,
             double part1) const;
  void join(const Node& a, const Node& b, double cap);
  /// Pieces of one window, which become cells of the relaxation; returns one past its last.
  std::size_t pose(std::size_t first, bool rest_first, bool rest_last, bool& ends_at_rest);

  const BoundGrid<N>& grid_;
  ProgressScope& pulse_;
  double cycle_time_;
  bool limited_ = false;
  std::size_t cells_ = 0;
  double ramp_ = std::numeric_limits<double>::infinity();  ///< s, shortest time from no acceleration to the limit
  double acceleration_of_ramp_ = 0;                        ///< of that axis
  double spacing_ = 0;                                     ///< s, time of a cell
  double first_piece_ = 0;                                 ///< mm, next to rest
  /// Per node of the grid: the longest piece, mm, that rests and steps of acceleration before and behind it allow here.
  std::vector<double> before_, behind_;
  /// About how fast a motion is, v^(3/2), at the nodes of the grid, feeds apart; and by how much that may grow per mm.
  /// Decides where pieces are short, no more.
  std::vector<double> expected_, growth_;
  std::vector<DualPiece<N>> pieces_;
  std::vector<Extent> extents_;       ///< of each
  std::vector<std::size_t> cell_of_;  ///< per piece of the window
  DualJoint<N> joint_;                ///< before the piece to come
  RelaxationProblem<N> problem_;
  RelaxationWindows<N> solver_;
  JerkDual<N> dual_;
};

extern template class JerkBound<2>;
extern template class JerkBound<3>;
extern template class JerkBound<8>;

}  // namespace bahnwerk::verify
