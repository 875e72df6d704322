#pragma once
/// The pieces of a path for the bound under limited jerk (core/verify/bound/jerk_bound.hpp), each with the largest b =
/// v² on it.
///
/// Pieces are short enough to resolve jerk: by time, by turn, by the change of centripetal acceleration, and shorter
/// towards rests and towards joints at which an axis has to step by more acceleration than one cycle allows. Where
/// curvature changes, jerk limits b as well (core/verify/bound/jerk_cap.hpp).
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/verify/bound/blocks.hpp"
#include "core/verify/bound/bound_grid.hpp"
#include "core/verify/bound/jerk_cap.hpp"
#include "core/verify/bound/jerk_dual.hpp"
#include "core/verify/bound/one_way.hpp"

namespace bahnwerk::verify {

/// `N` is the number of axes of the BoundGrid.
template <int N>
class JerkPieces {
 public:
  using Row = std::array<double, N>;
  /// Properties of a piece that limit the length of cells.
  struct Extent {
    double swing = 0;    ///< change of q″_k b along the piece, relative to A_k
    double finest = 0;   ///< longest cell here, mm
    double spacing = 0;  ///< longest cell here, s
    double piece = 0;    ///< longest piece, mm
  };
  /// Returns the number of pieces of equal length per cell, independent of rounding.
  double per_cell() const { return per_cell_; }

  /// `grid` and `progress` have to outlive the object. `shown` is the jerk per axis that pieces have to resolve.
  JerkPieces(const BoundGrid<N>& grid, double cycle_time, const Row& shown, ProgressScope& progress);

  /// Starts with the first nodes of the current grid, at which v² is at most `b`, which has to outlive the pieces. A
  /// cell takes at most `spacing` s; next to rest pieces begin with `first_piece` mm. Pieces are computed on demand,
  /// O(1) each. `fine`: on Cartesian axes twice as many where jerk changes the speed.
  void begin(const std::vector<double>& b, bool rest_first, bool rest_last, double spacing, double first_piece,
             bool fine);
  /// Returns whether there is a piece i; if so, the lists contain it.
  bool has(std::size_t i);
  /// Removes the first `count` pieces; the following one becomes piece 0. O(count).
  void drop(std::size_t count);
  bool dropped() const { return dropped_; }  ///< whether pieces were removed since begin()

  const Blocks<DualPiece<N>>& list() const { return pieces_; }
  const Blocks<Extent>& extents() const { return extents_; }  ///< extent of each piece

 private:
  using Node = BoundNode<N>;
  using Cell = BoundCell<N>;

  void lay_next();
  void expect(const std::vector<double>& b, bool rest_first, bool rest_last);
  void grade(const std::vector<double>& b, bool rest_first, bool rest_last);
  double finest_at(std::size_t node, const std::vector<double>& b) const;
  /// Bounds of the gain of b over a cell, mm²/s², and of b anywhere in it.
  struct Room {
    double energy, cap;
  };
  Room room(std::size_t cell, const std::vector<double>& b) const;
  Extent extent(std::size_t cell, double x, const Room& room, const std::vector<double>& b) const;
  void divide(std::size_t cell, const Room& room, const std::vector<double>& b);
  std::size_t joined(std::size_t first, const Room& room, const std::vector<double>& b);
  /// A piece before it is appended: between two places in the cells `first` to `last` of the grid.
  struct Draft {
    const Node &a, &b;
    std::size_t first, last;
    Extent extent;
    double cap;      // largest b, mm²/s²
    double without;  // the same without limits of jerk
  };
  DirectionRange<N> range(const Draft& draft) const;
  void append(const Draft& draft, int depth = 0);
  void push(const Draft& draft);
  double cap(std::size_t cell, const Node& a, const Node& b, const std::vector<double>& at_nodes,
             const Row* steepest) const;
  void join(const Node& a, const Node& b, double cap);

  const BoundGrid<N>& grid_;
  ProgressScope& progress_;
  double cycle_time_;
  double per_cell_;
  double part_of_distance_;  ///< part of the distance from rest that a piece takes
  double slower_;            ///< ratio of v³ in slow_ to that in expected_, at high curvature
  double much_change_;       ///< change of b along a piece above which it is halved
  Row shown_jerk_;
  double part_of_change_ = 0;  ///< time of a cell relative to the time in which jerk changes the speed
  double spacing_ = 0;         ///< time of a cell, s
  double first_piece_ = 0;     ///< length of the piece next to a rest, mm
  /// Longest piece at each node of the grid, mm, that rests and steps of acceleration before and behind it allow.
  std::vector<double> before_, behind_;
  /// Approximate v^(3/2) of a motion at the nodes of the grid, without feeds; its lower estimate; and its largest
  /// growth per mm. They only decide where pieces are short.
  std::vector<double> expected_, slow_, growth_;
  JerkCapPiece<N> piece_;  ///< current piece
  OneWay<N> one_way_;
  Blocks<DualPiece<N>> pieces_;
  Blocks<Extent> extents_;
  DualJoint<N> joint_;                         ///< joint before the next piece
  const std::vector<double>* most_ = nullptr;  ///< largest v² at the nodes
  std::size_t next_ = 0;                       ///< next cell of the grid
  bool dropped_ = false;
};

extern template class JerkPieces<2>;
extern template class JerkPieces<3>;
extern template class JerkPieces<5>;
extern template class JerkPieces<8>;

}  // namespace bahnwerk::verify
