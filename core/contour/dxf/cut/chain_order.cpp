#include "core/contour/dxf/cut/chain_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/progress_scope.hpp"
namespace bahnwerk {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// Points that can be removed, and the nearest of those left.
class NearestTree {
 public:
  NearestTree(const std::vector<Vec>& points, ProgressScope& progress)
      : points_(points),
        order_(points.size()),
        leaf_of_(points.size()),
        alive_(points.size(), true),
        progress_(progress) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    if (!points.empty()) build(0, points.size(), none);
  }

  void remove(std::size_t point) {
    if (!alive_[point]) return;
    alive_[point] = false;
    for (std::size_t n = leaf_of_[point]; n != none; n = nodes_[n].parent) --nodes_[n].alive;
  }

  /// The one left that is nearest to a point of the tree (which itself may be removed); `none` when all are. From the
  /// point's leaf upwards: where many lie in one place the first look finds one of them, and boxes that reach there,
  /// too, need not be opened.
  std::size_t nearest(std::size_t point) {
    const Vec p = points_[point];
    std::size_t best = none, node = leaf_of_[point];
    double square = HUGE_VAL;
    search(node, p, best, square);
    for (std::size_t above = nodes_[node].parent; above != none; node = above, above = nodes_[node].parent)
      search(node == above + 1 ? nodes_[above].right : above + 1, p, best, square);
    return best;
  }

 private:
  static constexpr std::size_t leaf_size = 8;
  struct Node {
    Vec low, high;
    std::size_t first, last, parent, alive, right = none;  // left child: the next node; leaf: right = none
  };

  std::size_t build(std::size_t first, std::size_t last, std::size_t parent) {
    progress_.work(last - first);
    const std::size_t id = nodes_.size();
    Vec low = points_[order_[first]], high = low;
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = points_[order_[i]][axis];
        low[axis] = std::min(low[axis], x);
        high[axis] = std::max(high[axis], x);
      }
    nodes_.push_back({low, high, first, last, parent, last - first});
    if (last - first <= leaf_size) {
      for (std::size_t i = first; i < last; ++i) leaf_of_[order_[i]] = id;
      return id;
    }
    const Vec size = high - low;
    const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](std::size_t i, std::size_t k) {
      return points_[i][axis] != points_[k][axis] ? points_[i][axis] < points_[k][axis] : i < k;
    });
    build(first, middle, id);
    const std::size_t right = build(middle, last, id);
    nodes_[id].right = right;
    return id;
  }

  /// Square of the distance from a node's box.
  double away(std::size_t node, Vec p) const {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = std::max({nodes_[node].low[axis] - p[axis], p[axis] - nodes_[node].high[axis], 0.0});
      sum += d * d;
    }
    return sum;
  }

  void search(std::size_t id, Vec p, std::size_t& best, double& square) {
    progress_.work();
    const Node& node = nodes_[id];
    if (node.alive == 0 || away(id, p) >= square) return;
    if (node.right == none) {
      for (std::size_t i = node.first; i < node.last; ++i) {
        const std::size_t k = order_[i];
        if (!alive_[k]) continue;
        const double d = dot(points_[k] - p, points_[k] - p);
        if (d < square || (d == square && k < best)) {
          square = d;
          best = k;
        }
      }
      return;
    }
    const bool left_first = away(id + 1, p) <= away(node.right, p);
    search(left_first ? id + 1 : node.right, p, best, square);
    search(left_first ? node.right : id + 1, p, best, square);
  }

  const std::vector<Vec>& points_;
  std::vector<std::size_t> order_, leaf_of_;
  std::vector<bool> alive_;
  std::vector<Node> nodes_;
  ProgressScope& progress_;
};

}  // namespace

std::vector<ChainVisit> nearest_order(const std::vector<ChainEntries>& chains, Progress progress) {
  std::vector<Vec> points;
  std::vector<std::size_t> first_of, chain_of;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    first_of.push_back(points.size());
    points.insert(points.end(), chains[c].at.begin(), chains[c].at.end());
    chain_of.resize(points.size(), c);
  }
  ProgressScope reading(progress.part(0, 0), "reading");
  NearestTree tree(points, reading);
  std::vector<ChainVisit> order;
  for (std::size_t next = points.empty() ? none : 0; next != none;) {
    const std::size_t c = chain_of[next], entry = next - first_of[c];
    order.push_back({c, entry});
    for (std::size_t i = 0; i < chains[c].at.size(); ++i) tree.remove(first_of[c] + i);
    next = tree.nearest(first_of[c] + (chains[c].closed ? entry : 1 - entry));
  }
  return order;
}

}  // namespace bahnwerk
