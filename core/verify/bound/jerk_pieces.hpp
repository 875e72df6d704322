#pragma once
/// The pieces of a path on which the bound under limited jerk stands (core/verify/bound/jerk_bound.hpp), each with the
/// largest b = v² on it.
///
/// They are short enough for what jerk does: by time, by turn, by the change of centripetal acceleration, finer and
/// finer towards rests and towards joints at which an axis has to step by more acceleration than one cycle allows.
/// Where curvature changes b is limited besides (core/verify/bound/jerk_cap.hpp).
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

/// N axes as the BoundGrid has them.
template <int N>
class JerkPieces {
 public:
  using Row = std::array<double, N>;
  /// What a piece says about cells.
  struct Extent {
    double swing = 0;    ///< by how much q″_k b changes along it, over A_k
    double finest = 0;   ///< mm, longest cell here
    double spacing = 0;  ///< s, longest cell here
    double piece = 0;    ///< mm, longest piece
    double speed = 0;    ///< mm/s, about how fast a motion is
    /// Through kinematics: by how much the acceleration of an axis against its direction (ahead) and in it (behind) may
    /// exceed √(2 J u), u its speed; infinite where it may turn round.
    Row ahead{}, behind{};
  };
  /// Pieces of the same length that make up a cell, whatever rounding does.
  double per_cell() const { return per_cell_; }

  /// `grid` and `pulse` outlive it. `shown`: per axis the jerk for which pieces are to be short enough.
  JerkPieces(const BoundGrid<N>& grid, double cycle_time, const Row& shown, ProgressScope& pulse);

  /// Of the first nodes of the grid at hand, at which v² is `b` at most, which outlives them. A cell takes `spacing` s
  /// at most; next to rest pieces begin with `first_piece` mm. Pieces come when they are asked for, O(1) each. `fine`:
  /// on Cartesian axes twice as many where jerk changes the speed.
  void begin(const std::vector<double>& b, bool rest_first, bool rest_last, double spacing, double first_piece,
             bool fine);
  /// Whether there is a piece i; if so, the lists reach so far.
  bool has(std::size_t i);
  /// The first `count` are not needed any more: what follows them is piece 0 from now on. O(those that follow).
  void drop(std::size_t count);
  bool dropped() const { return dropped_; }  ///< any, since begin()

  const Blocks<DualPiece<N>>& list() const { return pieces_; }
  const Blocks<Extent>& extents() const { return extents_; }  ///< of each

 private:
  using Node = BoundNode<N>;
  using Cell = BoundCell<N>;

  void lay_next();
  void expect(const std::vector<double>& b, bool rest_first, bool rest_last);
  void grade(const std::vector<double>& b, bool rest_first, bool rest_last);
  double finest_at(std::size_t node, const std::vector<double>& b) const;
  /// What b may gain over a cell, mm²/s², and what it is at most anywhere in it.
  struct Room {
    double energy, cap;
  };
  Room room(std::size_t cell, const std::vector<double>& b) const;
  Extent extent(std::size_t cell, double x, const Room& room, const std::vector<double>& b) const;
  void divide(std::size_t cell, const Room& room, const std::vector<double>& b);
  std::size_t joined(std::size_t first, const Room& room, const std::vector<double>& b);
  DirectionRange<N> range(const Node& a, const Node& b, std::size_t first, std::size_t last) const;
  void append(const Node& a, const Node& b, double cap, Extent extent, std::size_t first, std::size_t last,
              int depth = 0, double without = 0);
  void push(const Node& a, const Node& b, double cap, double without, Extent extent);
  double cap(std::size_t cell, const Node& a, const Node& b, const std::vector<double>& at_nodes,
             const Row* steepest) const;
  void join(const Node& a, const Node& b, double cap);

  const BoundGrid<N>& grid_;
  ProgressScope& pulse_;
  double cycle_time_;
  double per_cell_;
  double part_of_distance_;  ///< from rest, that a piece takes
  double slower_;            ///< v³ in slow_, of that in expected_, at bends
  double much_change_;       ///< of b along a piece: what jerk leaves is better known of halves
  Row shown_jerk_;
  double part_of_change_ = 0;  ///< that a cell takes, of the time in which jerk changes the speed by some of it
  double spacing_ = 0;         ///< s, time of a cell
  double first_piece_ = 0;     ///< mm, next to rest
  /// Per node of the grid: the longest piece, mm, that rests and steps of acceleration before and behind it allow here.
  std::vector<double> before_, behind_;
  /// About how fast a motion is, v^(3/2), at the nodes of the grid, feeds apart; how slow it may be; and by how much
  /// that may grow per mm. Decides where pieces are short, no more.
  std::vector<double> expected_, slow_, growth_;
  JerkCapPiece<N> piece_;  ///< the one at hand
  OneWay<N> one_way_;
  Blocks<DualPiece<N>> pieces_;
  Blocks<Extent> extents_;
  DualJoint<N> joint_;                         ///< before the piece to come
  const std::vector<double>* most_ = nullptr;  ///< v² at the nodes
  std::size_t next_ = 0;                       ///< cell of the grid
  bool dropped_ = false;
};

extern template class JerkPieces<2>;
extern template class JerkPieces<3>;
extern template class JerkPieces<5>;
extern template class JerkPieces<8>;

}  // namespace bahnwerk::verify
