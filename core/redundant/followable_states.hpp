#pragma once
/// States (position, velocity) of a coarse axis from which, or to which, it can follow the head along a chain of cells:
/// a convex polygon, carried from node to node.
///
/// It is the set itself, up to rounding, as long as it has no more than 96 vertices; beyond that those go that matter
/// least, so the polygon lies inside the set: what it allows is possible. A solution of the chain costs some 20 times
/// as much, and tells multipliers and the best motion; this only tells whether there is one.
#include <cstddef>
#include <vector>

#include "core/redundant/chain.hpp"

namespace bahnwerk {

class FollowableStates {
 public:
  /// Whatever a node's boxes allow, or rest inside that of its positions.
  static FollowableStates at_node(const std::array<Range, 2>& boxes, bool rest);

  bool empty() const { return vertices_.empty(); }
  /// To the end of a cell of duration h, or to its begin where h < 0, with controls in a range.
  void advance(double h, const Range& controls);
  void limit(const std::array<Range, 2>& boxes);
  /// Whether a state is in both. One of them has to have an inside.
  bool meets(const FollowableStates& other) const;

 private:
  using State = ChainState<2>;
  void cut(double x, double v, double most);
  void add_segment(const State& g);
  void reduce();

  std::vector<State> vertices_, spare_;  // counter-clockwise; two of a set without an inside
};

/// From the first node of a chain to the last (or back), starting from `states` there. Boxes of the first node are not
/// looked at. Ends early where nothing is left. O(cells).
FollowableStates followed_forward(FollowableStates states, const Chain<2>& chain, std::size_t first, std::size_t last);
FollowableStates followed_backward(FollowableStates states, const Chain<2>& chain, std::size_t first, std::size_t last);

}  // namespace bahnwerk
