#pragma once
/// States (position, velocity) of a coarse axis from which, or to which, it can follow the head along a chain of cells:
/// a convex polygon, carried from node to node.
///
/// It is the set itself, up to rounding, as long as it has no more than 96 vertices; beyond that those go that matter
/// least, so the polygon lies inside the set: what it allows is possible. A solution of the chain costs some 20 times
/// as much, and tells multipliers and the best motion; this only tells whether there is one.
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "core/redundant/chain.hpp"

namespace bahnwerk {

class ControllableSet {
 public:
  /// Whatever a node's boxes allow, or rest inside that of its positions.
  static ControllableSet at_node(const std::array<Range, 2>& boxes, bool rest);

  bool empty() const { return vertices_.empty(); }
  /// Carries the set to the end of a cell of duration h, or to its begin where h < 0, with controls in a range.
  void advance(double h, const Range& controls);
  void limit(const std::array<Range, 2>& boxes);
  /// Tells whether a state is in both. One of them has to have an inside.
  bool meets(const ControllableSet& other) const;

 private:
  using State = ChainState<2>;
  void cut(double x, double v, double most);
  void add_segment(const State& g);
  void reduce();

  std::vector<State> vertices_, spare_;  // counter-clockwise; two of a set without an inside
};

/// Carries sets from the first node of a chain to the last (or back), starting from `states` there. Boxes of the first
/// node are not looked at. Ends early where nothing is left. O(cells).
ControllableSet followed_forward(ControllableSet states, const Chain<2>& chain, std::size_t first, std::size_t last);
ControllableSet followed_backward(ControllableSet states, const Chain<2>& chain, std::size_t first, std::size_t last);

/// Returns the stretches that no motion can follow, as first and last node: none between them, wherever it is at the
/// last one, ends in a state that boxes allow. After each the search goes on from its middle, so that of those that
/// overlap only some are found. Beyond 96 vertices sets are smaller than they should be: a stretch may be one that
/// could just be followed. `tick` is called often. O(cells), three times for those of a stretch.
std::vector<std::pair<std::size_t, std::size_t>> conflicts(const Chain<2>& chain, const std::function<void()>& tick);

}  // namespace bahnwerk
