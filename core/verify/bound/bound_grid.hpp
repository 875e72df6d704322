#pragma once
/// The nodes of the lower bound: places on the path with the conditions that every motion has to satisfy there.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/verify/bound/blocks.hpp"
#include "core/verify/bound/bound_node.hpp"
#include "core/verify/bound/direction_range.hpp"
#include "core/verify/bound/hodograph.hpp"

namespace bahnwerk::verify {

/// The grid of an axis path of at most N axes; N is 2, 3, 5 or max_axes.
template <int N>
class BoundGrid {
 public:
  using Node = BoundNode<N>;
  using Cell = BoundCell<N>;
  static constexpr double widest_turn = 0.02;  ///< largest turn of q' in a cell, rad
  static constexpr double widest_change =
      0.1;  ///< largest change of q'' over half a cell, relative to q''; wider cells are halved

  /// `path` and `progress` have to outlive the object. `feeds` are speeds of the tool per segment, infinite where not
  /// limited. O(panels) for axes through kinematics.
  BoundGrid(const AxisPath& path, const Machine& machine, std::vector<double> feeds, double corner_angle,
            ProgressScope& progress);

  /// Makes cells of grids that are built later up to `factor` ≤ 8 times as wide. The bound remains valid; its loss
  /// grows with the square of the width.
  void widen(double factor) {
    turn_ = factor * widest_turn;
    change_ = factor * widest_change;
  }
  /// Builds the first grid over the segments [first, last). At each end the motion is at rest, or as fast as the limits
  /// at that place allow.
  void build(std::size_t first, std::size_t last, bool rest_first = true, bool rest_last = true);
  /// Returns the number of cells that begin in segments before this one. O(log n).
  std::size_t cells_before(std::size_t segment) const {
    const auto behind = std::partition_point(order_.begin(), order_.end() - 1,
                                             [&](std::uint32_t id) { return nodes_[id].segment < segment; });
    return static_cast<std::size_t>(behind - order_.begin());
  }
  /// Limits b at the beginning of the grid to `most`.
  void enter(double most) {
    Node& first = nodes_[order_.front()];
    first.cap = std::min(first.cap, most);
  }
  /// Quarters the marked cells; marks are in the order of cells(). Results of the other cells stay valid. O(marked) and
  /// 1 ns per node for their order.
  void refine(const std::vector<unsigned char>& marked);

  std::size_t axes() const { return axes_; }
  bool cartesian() const { return path_.cartesian(); }
  double acceleration(std::size_t k) const { return acceleration_[k]; }
  const std::array<double, N>& accelerations() const { return acceleration_; }
  double velocity(std::size_t k) const { return velocity_[k]; }
  double jerk(std::size_t k) const { return jerk_[k]; }  ///< may be infinite
  double feed(std::size_t segment) const { return feeds_[segment]; }
  /// Returns the nodes along the path; cell i lies between node i and node i + 1.
  Ordered<Node, std::uint32_t> nodes() const { return {nodes_, order_.data(), order_.size()}; }
  Ordered<Cell, std::uint32_t> cells() const { return {cells_, order_.data(), order_.size() - 1}; }
  /// Nodes by BoundNode::id, which is unchanged when the grid is refined, and the cells that begin at them.
  const std::vector<std::uint32_t>& order() const { return order_; }
  std::size_t ids() const { return nodes_.size(); }
  const Node& node_of(std::uint32_t id) const { return nodes_[id]; }
  const Cell& cell_of(std::uint32_t id) const { return cells_[id]; }
  /// Part of the grid that has changed: between nodes `first` and `last` of order() all cells are new since the last
  /// build() or refine(), and nodes, these two included, are new or may have another cap. Spans are ascending.
  struct Span {
    std::uint32_t first, last;
  };
  const std::vector<Span>& fresh() const { return fresh_; }
  /// Returns the range of q' between two nodes of one segment.
  DirectionRange<N> range(const Node& a, const Node& b) const;
  /// Makes enclosures between two nodes serve for all intervals within them, until forget(); it has an effect through
  /// kinematics alone.
  void remember(const Node& a, const Node& b) const;
  void forget() const { whole_.segment = static_cast<std::size_t>(-1); }
  /// Returns bounds of |q'''_k|, 1/mm², between two nodes of one segment; infinite where there are none.
  std::array<double, N> third(const Node& a, const Node& b) const;
  /// Returns the largest b = v² that limits of jerk allow at any place between two nodes of one segment; infinite where
  /// unknown, and where the axes are the tool's coordinates.
  double jerk_cap(const Node& a, const Node& b) const;
  /// Returns the node at a place of a segment.
  Node node(std::size_t segment, double u) const {
    Node n = place(segment, u);
    complete(n);
    return n;
  }
  /// Returns whether |q'| = 1 and q'' ⟂ q' there, so that no axis along which the tool moves is left out.
  bool unit_direction(const Node& n) const;
  double path_length(const Node& n) const { return path_[n.segment].s0() + n.s; }
  /// Returns the largest |v̇| along the path on both sides of a joint, mm/s², where b is at most `cap`.
  double along(const Node& a, const Node& b, double cap) const;

 private:
  using Row = std::array<double, N>;
  /// Properties of a segment that every node needs.
  struct Shape {
    const Arc* arc = nullptr;            ///< the segment's arc; null for other curves
    const Rational* rational = nullptr;  ///< the segment's rational piece; null for other curves
    double first = 0, last = 0;          ///< parameters at both ends
    double third = 0;                    ///< |h'''| of arcs, 1/mm²
    bool linear = false;                 ///< whether all axes are linear in s
  };
  const Shape& shape(std::size_t segment) const {
    if (segment != shape_of_) learn(segment);
    return shape_;
  }
  void learn(std::size_t segment) const;
  void scale_axes();
  Node place(std::size_t segment, double u) const;  ///< returns a node with position and derivatives only
  void complete(Node& n) const;
  double place_cap(const Node& n) const;
  double turn_cap(const Node& n) const;
  bool changes(const Node& a, const Node& middle, const Node& b) const;
  double valley(const Node& a, const Node& middle, const Node& b) const;
  bool too_wide(const Node& a, const Node& b) const;
  double corner(const Node& a, const Node& b) const;
  double step_cap(const Node& a, const Node& b, double cap) const;
  void divide(std::uint32_t first, std::uint32_t last);
  void append_segment(std::size_t segment);
  void append_between(const Node& a, const Node& b, int depth);
  void append_with_roots(const Node& a, const Node& b, int axis, int depth = 0);
  void append_monotone(const Node& a, const Node& b, int depth);
  void append(const Node& b, const DirectionRange<N>* range = nullptr);
  Cell cell(Node& a, Node& b, const DirectionRange<N>* range) const;
  DirectionRange<N> range_by_map(const Node& a, const Node& b) const;
  /// Enclosures of q' and q'', and bounds of |q'''|, between two places of a segment, for axes through kinematics.
  struct AxisSizes {
    Row low{}, high{}, q2_low{}, q2_high{}, third{};
    Row least_third{};  ///< lower bounds of |q'''|
  };
  double jerk_cap(const AxisSizes& sizes) const;
  /// `depth` limits how often the interval, `length` mm, is halved to find enclosures of short intervals.
  AxisSizes axis_sizes(std::size_t segment, double u0, double u1, double length, int depth) const;
  /// Returns the sizes between two nodes; the last ones are stored, since several figures of a cell follow from them.
  const AxisSizes& axis_sizes(const Node& a, const Node& b) const;
  AxisSizes within(const AxisSizes& whole, const Node& a, const Node& b) const;
  Hodograph::DerivativeBounds derivative_bounds(std::size_t segment, double u0, double u1) const;
  Hodograph& hodograph(std::size_t segment) const;

  const AxisPath& path_;
  std::size_t axes_;
  Row scale_{}, acceleration_{}, velocity_{}, jerk_{};
  std::array<bool, N> still_{};  ///< axes that stand still but for rounding: their conditions are dropped
  double cycle_time_, corner_angle_;
  double turn_ = widest_turn, change_ = widest_change;  ///< widths of the grids that are built later
  std::vector<double> feeds_;
  ProgressScope& progress_;
  Blocks<Node> nodes_;
  Blocks<Cell> cells_;  ///< cell with the id of its first node
  std::vector<std::uint32_t> order_, former_;
  std::vector<Span> fresh_;
  double valley_ = unlimited;  ///< BoundCell::valley of the cells that are being appended
  bool jerk_limited_ = false;
  struct SizedInterval {
    std::size_t segment = static_cast<std::size_t>(-1);
    double u0 = 0, u1 = 0;
    AxisSizes sizes;
  };
  mutable SizedInterval stretch_;  ///< interval of the last query
  mutable SizedInterval whole_;    ///< interval of remember()
  mutable Shape shape_;            ///< shape of the segment of the last query
  mutable std::size_t shape_of_ = static_cast<std::size_t>(-1);
  mutable std::optional<Hodograph> hodograph_;  ///< hodograph of the segment of the last query
  mutable std::size_t hodograph_of_ = 0;
};

extern template class BoundGrid<2>;
extern template class BoundGrid<3>;
extern template class BoundGrid<5>;
extern template class BoundGrid<8>;

}  // namespace bahnwerk::verify
