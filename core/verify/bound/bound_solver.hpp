#pragma once
/// The largest b = v² that any motion may have at the nodes of a bound grid, and the least time that follows.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/verify/bound/bound_grid.hpp"

namespace bahnwerk::verify {

/// Solves a grid by a forward and a backward pass, and solves it again where refinement has changed it: from each group
/// of new nodes b is recomputed, forwards and backwards, as far as it changes. The results equal those of a complete
/// solution to the last bit. Cost: 30 to 60 ns per node reached, for two axes.
template <int N>
class BoundSolver {
 public:
  /// `grid` and `progress` have to outlive the object.
  BoundSolver(const BoundGrid<N>& grid, ProgressScope& progress) : grid_(grid), progress_(progress) {}

  /// Solves the whole grid.
  void solve();
  /// Solves the changes after BoundGrid::refine() of the grid that was solved before.
  void solve_changes();
  /// Returns the duration of the first cells, s. O(cells).
  double duration(std::size_t cells) const;
  double duration() const { return duration(grid_.order().size() - 1); }
  /// Returns b of a node, or the time of the cell that begins there, by the node's id.
  double speed_square(std::uint32_t id) const { return b_[id]; }
  double cell_time(std::uint32_t id) const { return time_[id]; }
  /// Returns b of the first `count` nodes along the path. O(count).
  std::vector<double> speed_squares(std::size_t count) const {
    std::vector<double> list;
    list.reserve(count);
    for (std::size_t i = 0; i < count; ++i) list.push_back(b_[grid_.order()[i]]);
    return list;
  }

  struct Doubt {
    std::size_t cells = 0;  ///< number of cells in which the binding condition may change
    double time = 0;        ///< time spent in cells without a single binding condition, s
  };
  /// Marks, in the order of BoundGrid::cells(), the new cells inside which b reaches a minimum of the caps. Returns
  /// their number.
  std::size_t mark_valleys(std::vector<unsigned char>& marked) const;
  /// Marks the cells without a condition that binds throughout, and the neighbours of a change. After the first call
  /// only cells that solve_changes() has reached are evaluated: call it after each of them. Cells that take less than
  /// 1e-10 of `total` do not count.
  Doubt mark_switching(double total, std::vector<unsigned char>& marked);

 private:
  using Node = BoundNode<N>;
  using Cell = BoundCell<N>;
  using Span = typename BoundGrid<N>::Span;
  static constexpr unsigned char curved = 1, divisible = 2, mixed = 4;  // the last: no single condition explains it
  static constexpr double unsolved = std::numeric_limits<double>::quiet_NaN();

  void grow();
  void solve(const std::vector<Span>& fresh);
  void forwards(const std::vector<Span>& all);
  void backwards();
  void look_at(const Node& from, const Node& to);
  bool disputed(unsigned active, const Node& from, const Node& to) const;
  double time_of(const Cell& cell, const Node& from, const Node& to, unsigned char& active) const;

  const BoundGrid<N>& grid_;
  ProgressScope& progress_;
  // Entries belong to nodes and cells by their ids. `ahead_` is the largest b after the forward pass. `active_` is 0
  // for none, else the condition that binds from one end of the cell to the other: feed, axis accelerates, brakes, runs
  // at its velocity. `state_` has the flags above.
  std::vector<double> ahead_, b_, time_;
  std::vector<unsigned char> active_, state_;
  std::vector<Span> reached_;  ///< nodes [first, last) that the passes reached
  bool looked_ = false;        ///< whether mark_switching() has evaluated all other cells
};

extern template class BoundSolver<2>;
extern template class BoundSolver<3>;
extern template class BoundSolver<5>;
extern template class BoundSolver<8>;

}  // namespace bahnwerk::verify
