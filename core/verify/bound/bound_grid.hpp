#pragma once
/// The nodes of the lower bound: places on the path with what every motion has to respect there.
#include <algorithm>
#include <array>
#include <boost/container/deque.hpp>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk::verify {

struct BoundNode {
  Vec position, tangent, curvature;  ///< mm, 1, 1/mm; curvature 0 at cusps, where the speed is 0 anyway
  double s = 0, u = 0;               ///< arc length, mm, and the segment's parameter
  double cap = 0;                    ///< largest b = v² allowed at this place itself, mm²/s², may be infinite
  double blur = 0;                   ///< how far rounding may have moved a component of the tangent
  std::size_t segment = 0;

  /// Bounds of h'_k² under that rounding: conditions are always used in their weaker reading.
  double least(std::size_t k) const { return square(std::max(0.0, std::abs(tangent[k]) - blur)); }
  double most(std::size_t k) const { return square(std::abs(tangent[k]) + blur); }

 private:
  static double square(double x) { return x * x; }
};

/// Between node i and node i + 1. Across a joint both nodes are the same place with the tangents of either side; so
/// they are where a root of h'_k falls onto the end of a segment, up to the rounding of s.
struct BoundCell {
  enum class Kind : unsigned char { straight, curved, joint };
  std::array<double, 3> energy{};    ///< 2 A_k ∫|h'_k| ds from above, mm²/s²: what |h'_k² b| may change by
  std::array<double, 3> way{};       ///< |Δx_k| from below, mm
  std::array<double, 3> velocity{};  ///< what axis k may run at, by its own limit, the feed and the other axes', mm/s
  double length = 0;                 ///< mm
  double slip = 0;                   ///< across a joint: what b may change by, mm²/s²
  Kind kind = Kind::joint;
  bool divisible = false;  ///< curved, and long enough for its coordinates to tell more when halved
};

/// Grows without moving what it holds: copying a large grid would take longer than progress may wait.
template <class T>
using Blocks =
    boost::container::deque<T, LargePages<T>, boost::container::deque_options_t<boost::container::block_size<4096>>>;

class BoundGrid {
 public:
  BoundGrid(const Contour& contour, const Machine& machine, double corner_angle, ProgressScope& pulse);

  /// The first grid over the segments [first, last), at rest where it begins and ends or as fast there as the place
  /// itself allows.
  void build(std::size_t first, std::size_t last, bool rest_first = true, bool rest_last = true);
  /// Quarters the cells marked. O(n).
  void refine(const std::vector<unsigned char>& marked);

  std::size_t axes() const { return axes_; }
  double acceleration(std::size_t k) const { return acceleration_[k]; }
  double velocity(std::size_t k) const { return velocity_[k]; }
  double feed(std::size_t segment) const { return feeds_[segment]; }
  const Blocks<BoundNode>& nodes() const { return nodes_; }
  const Blocks<BoundCell>& cells() const { return cells_; }

 private:
  BoundNode node(std::size_t segment, double u) const;
  double place_cap(const BoundNode& n) const;
  static bool hides_valley(const BoundNode& a, const BoundNode& middle, const BoundNode& b);
  bool too_wide(const BoundNode& a, const BoundNode& b, double turn_limit) const;
  void append_segment(std::size_t segment);
  void append_between(const BoundNode& a, const BoundNode& b, int depth);
  void append_with_roots(const BoundNode& a, const BoundNode& b, int axis);
  void append(const BoundNode& b);
  BoundCell cell(BoundNode& a, BoundNode& b) const;

  const Contour& contour_;
  std::size_t axes_;
  std::array<double, 3> acceleration_{}, velocity_{};
  double cycle_time_, corner_angle_;
  std::vector<double> feeds_;
  ProgressScope& pulse_;
  Blocks<BoundNode> nodes_;
  Blocks<BoundCell> cells_;
};

}  // namespace bahnwerk::verify
