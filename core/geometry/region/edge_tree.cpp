#include "core/geometry/region/edge_tree.hpp"

namespace bahnwerk {

EdgeTree::EdgeTree(std::span<const Edge> edges) : count_(edges.size()) {
  if (count_ == 0) return;
  leaves_ = 1;
  while (leaves_ * block < count_) leaves_ *= 2;
  const double far = 1e300;
  boxes_.assign(2 * leaves_, {{far, far}, {far, far}});  // an empty box, beyond reach, is a leaf without edges
  const auto join = [&](Box& box, const Box& other) {
    if (box.low.x == far) {
      box = other;
    } else if (other.low.x != far) {
      box.low = {std::min(box.low.x, other.low.x), std::min(box.low.y, other.low.y)};
      box.high = {std::max(box.high.x, other.high.x), std::max(box.high.y, other.high.y)};
    }
  };
  // A box that is a little too large costs nothing; one that loses an edge to rounding would change what is nearest.
  for (std::size_t i = 0; i < count_; ++i) join(boxes_[leaves_ + i / block], extent(edges[i], 1e-9));
  for (std::size_t node = leaves_; --node > 0;) {
    join(boxes_[node], boxes_[2 * node]);
    join(boxes_[node], boxes_[2 * node + 1]);
  }
}

}  // namespace bahnwerk
