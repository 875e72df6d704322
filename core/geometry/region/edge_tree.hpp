#pragma once
/// The edges of a boundary in nested boxes, for queries of the edges nearest to a point.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/region/edge.hpp"

namespace bahnwerk {

/// A binary tree over blocks of edges in their order: consecutive edges lie side by side, so no sorting is needed. O(n)
/// to build; a query evaluates O(log n) blocks where one part of the boundary is clearly the nearest, and all
/// of them in the centre of a circle.
class EdgeTree {
 public:
  EdgeTree() = default;
  explicit EdgeTree(std::span<const Edge> edges);

  /// Calls `visit(first, last)` for blocks of edges in ascending distance of their boxes, as long as these are no
  /// farther than `best`, a squared distance in mm² that `visit` may reduce.
  template <class Visit>
  void near(Point p, const double& best, Visit visit) const {
    if (count_ > 0) near(1, p, best, visit);
  }

 private:
  static constexpr std::size_t block = 32;
  std::size_t count_ = 0, leaves_ = 0;
  std::vector<Box> boxes_;  ///< box of each node; the halves of node k are 2 k and 2 k + 1, leaves are last

  static double square_distance_to(const Box& box, Point p) {
    const double x = std::max({box.low.x - p.x, p.x - box.high.x, 0.0});
    const double y = std::max({box.low.y - p.y, p.y - box.high.y, 0.0});
    return x * x + y * y;
  }
  template <class Visit>
  void near(std::size_t node, Point p, const double& best, Visit& visit) const {
    if (node >= leaves_) {
      const std::size_t first = (node - leaves_) * block;
      visit(first, std::min(first + block, count_));
      return;
    }
    std::size_t halves[] = {2 * node, 2 * node + 1};
    double away[] = {square_distance_to(boxes_[halves[0]], p), square_distance_to(boxes_[halves[1]], p)};
    if (away[1] < away[0]) {
      std::swap(halves[0], halves[1]);
      std::swap(away[0], away[1]);
    }
    for (const int k : {0, 1})
      if (away[k] <= best) near(halves[k], p, best, visit);
  }
};

}  // namespace bahnwerk
