#pragma once
/// The nodes of the lower bound: places on the path with what every motion has to respect there.
#include <algorithm>
#include <array>
#include <boost/container/deque.hpp>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/verify/bound/direction_range.hpp"
#include "core/verify/bound/hodograph.hpp"

namespace bahnwerk::verify {

/// Axes through kinematics have any units: they are scaled by powers of two so that |q'_k| is about 1 at most, and
/// their limits likewise. Cartesian axes stay as they are.
template <int N>
struct BoundNode {
  std::array<double, N> position{}, tangent{}, curvature{};  ///< q, q', q'' by path length; q'' is 0 at cusps
  double s = 0, u = 0;                                       ///< arc length, mm, and the segment's parameter
  double cap = 0;   ///< largest b = v² allowed at this place itself, mm²/s², may be infinite
  double blur = 0;  ///< how far rounding may have moved a component of q'
  std::size_t segment = 0;

  /// Bounds of q'_k² under that rounding: conditions are always used in their weaker reading.
  double least(std::size_t k) const { return square(std::max(0.0, std::abs(tangent[k]) - blur)); }
  double most(std::size_t k) const { return square(std::abs(tangent[k]) + blur); }

 private:
  static double square(double x) { return x * x; }
};

/// Between node i and node i + 1. Across a joint both nodes are the same place with the tangents of either side; so
/// they are where a root of h'_k falls onto the end of a segment, up to the rounding of s.
template <int N>
struct BoundCell {
  enum class Kind : unsigned char { straight, curved, joint };
  std::array<double, N> energy{};    ///< 2 A_k ∫|q'_k| ds from above: what |q'_k² b| may change by
  std::array<double, N> way{};       ///< |Δq_k| from below
  std::array<double, N> velocity{};  ///< what axis k may run at, by its own limit, the feed and the other axes'
  double length = 0;                 ///< mm
  double slip = 0;                   ///< across a joint: what b may change by, mm²/s²
  Kind kind = Kind::joint;
  bool divisible = false;  ///< curved, and long enough for its coordinates to tell more when halved
};

/// Grows without moving what it holds: copying a large grid would take longer than progress may wait. Ordinary memory:
/// the large pages kept from plan to plan are left to the planners, whose arrays fit them.
template <class T>
using Blocks =
    boost::container::deque<T, std::allocator<T>, boost::container::deque_options_t<boost::container::block_size<512>>>;

/// Over any axis path of at most N axes; N is 2, 3 or 8.
template <int N>
class BoundGrid {
 public:
  using Node = BoundNode<N>;
  using Cell = BoundCell<N>;

  /// `path` and `pulse` outlive it. `feeds`: speed of the tool per segment, infinite where not limited. O(panels) for
  /// axes through kinematics.
  BoundGrid(const AxisPath& path, const Machine& machine, std::vector<double> feeds, double corner_angle,
            ProgressScope& pulse);

  /// The first grid over the segments [first, last), at rest where it begins and ends or as fast there as the place
  /// itself allows.
  void build(std::size_t first, std::size_t last, bool rest_first = true, bool rest_last = true);
  /// Quarters the cells marked. O(n).
  void refine(const std::vector<unsigned char>& marked);

  std::size_t axes() const { return axes_; }
  double acceleration(std::size_t k) const { return acceleration_[k]; }
  double velocity(std::size_t k) const { return velocity_[k]; }
  double jerk(std::size_t k) const { return jerk_[k]; }  ///< may be infinite
  double feed(std::size_t segment) const { return feeds_[segment]; }
  const Blocks<Node>& nodes() const { return nodes_; }
  const Blocks<Cell>& cells() const { return cells_; }
  /// All that q' can be between two nodes of one segment.
  DirectionRange<N> range(const Node& a, const Node& b) const;
  /// Bounds of |q'''_k|, 1/mm², between two nodes of one segment; infinite where there are none.
  std::array<double, N> third(const Node& a, const Node& b) const;
  /// A place of a segment.
  Node at(std::size_t segment, double u) const { return node(segment, u); }

 private:
  using Row = std::array<double, N>;
  bool linear(std::size_t segment) const {
    return path_.cartesian() ? path_[segment].straight() : path_.linear(segment);
  }
  void scale_axes();
  Node node(std::size_t segment, double u) const;
  double place_cap(const Node& n) const;
  static bool hides_valley(const Node& a, const Node& middle, const Node& b);
  bool too_wide(const Node& a, const Node& b, double turn_limit) const;
  double corner(const Node& a, const Node& b) const;
  double step_cap(const Node& a, const Node& b, double cap) const;
  bool unit_direction(const Node& n) const;
  void append_segment(std::size_t segment);
  void append_between(const Node& a, const Node& b, int depth);
  void append_with_roots(const Node& a, const Node& b, int axis, int depth = 0);
  void append_monotone(const Node& a, const Node& b, int depth);
  void append(const Node& b, const DirectionRange<N>* range = nullptr);
  Cell cell(Node& a, Node& b, const DirectionRange<N>* range) const;
  DirectionRange<N> range_by_map(const Node& a, const Node& b) const;
  Row third_by_map(const Node& a, const Node& b, const MapBounds& map) const;
  Hodograph::Bends bends(const Node& a, const Node& b) const;
  Hodograph& hodograph(std::size_t segment) const;

  const AxisPath& path_;
  std::size_t axes_;
  Row scale_{}, acceleration_{}, velocity_{}, jerk_{};
  double cycle_time_, corner_angle_;
  std::vector<double> feeds_;
  ProgressScope& pulse_;
  Blocks<Node> nodes_;
  Blocks<Cell> cells_;
  mutable std::optional<Hodograph> hodograph_;  ///< of the segment asked for last
  mutable std::size_t hodograph_of_ = 0;
};

extern template class BoundGrid<2>;
extern template class BoundGrid<3>;
extern template class BoundGrid<8>;

}  // namespace bahnwerk::verify
