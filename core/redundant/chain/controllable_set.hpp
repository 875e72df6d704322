#pragma once
/// Reachable and controllable sets of a coarse axis that follows the head along a chain of order 2 (chain.hpp): convex
/// polygons of states (position, velocity), carried from node to node.
///
/// A polygon is exact up to rounding as long as it has no more than 96 vertices. Beyond that the vertices that
/// contribute the least area are removed, so the polygon lies inside the true set and every state in it is feasible. A
/// polygon costs about 1/20 of a solution of the chain (chain_solver.hpp), but only decides feasibility; the solution
/// also gives multipliers and the optimal motion.
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "core/redundant/chain/chain.hpp"

namespace bahnwerk {

class ControllableSet {
 public:
  /// Returns all states inside a node's boxes; with `rest` only those with velocity 0.
  static ControllableSet at_node(const std::array<Range, 2>& boxes, bool rest);

  /// Tells whether no state is feasible.
  bool empty() const { return vertices_.empty(); }
  /// Carries the set forward over a cell of duration h > 0, or backward over a cell of duration −h if h < 0, with any
  /// control in `controls`.
  void advance(double h, const Range& controls);
  /// Intersects the set with the boxes of a node.
  void limit(const std::array<Range, 2>& boxes);
  /// Tells whether the sets have a common state. At least one of them must have interior points.
  bool meets(const ControllableSet& other) const;

 private:
  using State = ChainState<2>;
  void cut(double x, double v, double most);
  void add_segment(const State& g);
  void reduce();

  std::vector<State> vertices_, spare_;  // counter-clockwise; a set without interior has two
};

/// Carries `states` from node `first` to node `last` (or back from `last` to `first`). The boxes of the node at which
/// it starts are not applied. Ends early if the set becomes empty. O(cells).
ControllableSet followed_forward(ControllableSet states, const Chain<2>& chain, std::size_t first, std::size_t last);
ControllableSet followed_backward(ControllableSet states, const Chain<2>& chain, std::size_t first, std::size_t last);

/// Returns intervals (first node, last node) that no trajectory can pass: none that begins inside the boxes of the
/// first node stays inside the boxes up to the last one. After each conflict the search continues from its middle, so
/// of overlapping conflicts only some are found. Above 96 vertices the sets are inner approximations, so that an
/// interval may be reported although it is just feasible. `tick` is called often. Cost: O(cells), three times that for
/// the cells of conflicts.
std::vector<std::pair<std::size_t, std::size_t>> conflicts(const Chain<2>& chain, const std::function<void()>& tick);

}  // namespace bahnwerk
