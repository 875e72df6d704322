#pragma once
/// The largest v² along one section: the chain b0 g0 b1 g1 … (core/motion/acceleration/reach.hpp), solved by one
/// backward and one forward pass [Bobrow 1985; Shin, McKay 1985; Pham, Pham 2018].
///
/// The backward pass computes the controllable sets: the largest v² from which the rest of the section can still be
/// driven. The forward pass takes, from rest, the largest v² inside them. Links are convex polygons around the origin,
/// so the forward pass always finds what the backward pass allows. After a change of some cells, only the part that
/// they influence is solved again. Cost: O(cells); four divisions per axis and cell, and two small linear programs
/// where an axis reverses (core/motion/acceleration/station_limits.hpp).
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/contour/contour.hpp"
#include "core/motion/acceleration/flags.hpp"
#include "core/motion/acceleration/station_limits.hpp"
#include "core/motion/grid/grid.hpp"
#include "core/motion/grid/sections.hpp"

namespace bahnwerk {

template <int N>
class SpeedChain {
 public:
  /// `reserve` is K_b of [Bock (2.11)] if a braking reserve is required.
  SpeedChain(const Grid<N>& grid, const std::vector<double>& feed, const Sections& sections, const Machine& machine,
             std::optional<double> reserve);

  /// Takes the current grid, entered at speed² `entry` (0 at rest).
  void start(double entry);
  /// Backward pass over the cells [first, last); it has to be called for all cells from the last one on. share(c) is
  /// the part of the acceleration limits that cell c may use.
  template <class Share>
  void backward(std::size_t first, std::size_t last, Share&& share);
  /// Forward pass over the cells [first, last); it has to be called for all cells from the first one on. done(c) is
  /// called for each as soon as its speeds are known. Each speed depends on the one before, so the caller's work in
  /// done() costs little.
  template <class Done>
  void forward(std::size_t first, std::size_t last, const UnsetVector<double>& share, Done&& done);
  /// Returns the first cell from the right whose law does not depend on the rest at the end of the grid, so that the
  /// law before it is final. Returns 0 if there is none.
  std::size_t unaffected(const UnsetVector<double>& share) const;
  /// Returns whether the law at cell c is slightly below its controllable set, so that its speed there depends on
  /// earlier cells only.
  bool slack(std::size_t c) const { return speed_[c].node < speed_[c].node_stop * (1 - 1e-4); }
  /// Returns whether cell c is driven at constant speed.
  bool steady(std::size_t c) const {
    return speed_[c].node == speed_[c].middle && speed_[c].node == speed_[c + 1].node;
  }
  /// Returns whether the entry speed is controllable.
  bool enters() const { return entry_ <= speed_[0].node_stop * (1 + 1e-12); }
  /// Divides the cells in step with the grid. An update has to follow in which every part of a divided cell is dirty.
  void divided(const LargeVector<std::uint8_t>& parts, ProgressScope& progress);
  /// Solves again where `dirty` cells (1) have a new share, and marks in `dirty` every cell whose speeds changed.
  void update(const UnsetVector<double>& share, CellFlags& dirty, ProgressScope& progress);

  double node(std::size_t c) const { return speed_[c].node; }  ///< v² at the left end of cell c, mm²/s²
  double middle(std::size_t c) const {
    return speed_[c].middle;
  }                                          ///< middle Bernstein coefficient of v² in cell c, mm²/s²
  double acceleration(std::size_t c) const;  ///< largest path acceleration of a straight cell, mm/s²
  double cap(std::size_t c) const { return caps(c).middle; }  ///< v² that a straight cell may hold

 private:
  static constexpr std::size_t none = -1;
  struct Caps {
    double left, middle,
        right;  // caps of v² from limits at one place; `middle` of a straight cell is its only cap
  };
  Caps caps(std::size_t c) const;
  double first_cap(std::size_t c, double cap) const;
  /// Returns the part of the limits that rows at the left end of a cell use. At a cusp it is half: the curvature is
  /// unbounded while v² κ → 0.
  double left_part(std::size_t c) const {
    return grid_.cells[c].any_way ? any_way(grid_.left(c)) : grid_.cells[c].cusp_left ? 0.5 : 1;
  }
  /// Returns the part at the right end.
  double right_part(std::size_t c) const {
    return grid_.cells[c].any_way ? any_way(grid_.right(c)) : grid_.cells[c].cusp_right ? 0.5 : 1;
  }
  /// Returns the part of the limits that half of the least acceleration is along the path: in a needle point the path
  /// turns through any direction, and curvature and path acceleration together take 1.3 times the acceleration along
  /// it.
  double any_way(const Station<N>& at) const {
    return 0.5 * largest(magnitude(at.d1) * limit_.inverse_acceleration) / largest(limit_.inverse_acceleration);
  }
  Rows<N> rows_left(std::size_t c, double share, bool flip) const;
  Rows<N> rows_right(std::size_t c, double share, bool flip) const;
  Rows<N> link(const Station<N>& at, double h, double share, bool flip, std::size_t segment) const;
  /// Solves links that are not plain, by search.
  [[gnu::noinline]] double search_left(std::size_t c, double share, double cap_node, double cap_middle) const;
  [[gnu::noinline]] double search_right(std::size_t c, double share, double cap_middle, double cap_node) const;
  struct Stop {
    double middle, node;
  };
  /// A station that the next cell may need, too.
  struct Known {
    std::size_t at = none;
    std::optional<PlainStation<N>> station;
    void set(std::size_t to, const PlainStation<N>& value) {
      at = to;
      station = value;
    }
  };
  /// `right` is the known right station of the cell, and afterwards the left one.
  Stop stop(std::size_t c, double share, double& next, Known& right) const;
  Stop step_back(std::size_t c, double share, const Caps& cap, double next, Known& right) const;
  /// `left` is the known left station of the cell, and afterwards the right one.
  double step_forward(std::size_t c, double share, Known& left);
  double right_cap(std::size_t c, double speed2) const;

  const Grid<N>& grid_;
  const std::vector<double>& feed_;
  const Sections& sections_;
  std::optional<double> reserve_;
  AxisBounds<N> limit_;
  double entry_ = 0;  // v² at the beginning
  double max_ = 0;    // v² that the section's length allows
  /// v² at the left end of a cell and its middle coefficient: the controllable ones, and those of the law.
  struct Speeds {
    double node_stop, middle_stop, node, middle;
  };
  UnsetVector<Speeds> speed_;  // one entry per node, one more than cells
};

template <int N>
template <class Share>
[[gnu::noinline]] void SpeedChain<N>::backward(std::size_t first, std::size_t last, Share&& share) {
  std::optional<PlainStation<N>> right;
  std::size_t at = none;  // index of that station
  double b = speed_[last].node_stop;
  for (std::size_t c = last; c-- > first;) {
    const GridCell& cell = grid_.cells[c];
    const double part = share(c);
    // The first cell of a segment has a cap of its own.
    bool plain = cell.regular() && !reserve_ && c > 0 && grid_.cells[c - 1].segment == cell.segment;
    if (plain) {
      const Station<N>* station = &grid_.stations[cell.station];
      const double h = station[1].s - station[0].s, feed = feed_[cell.segment], cap = std::min(max_, feed * feed);
      if (at != cell.station + 1) {
        right.emplace(station[1], limit_);
        // The cap of this cell on the node at its right may be applied afterwards: the links are convex and contain the
        // origin.
        speed_[c + 1].node_stop = b = std::min(b, cap);
      }
      const PlainStation<N> left(station[0], limit_);
      const PlainLink<N> in(left, h, part), out(*right, h, part);
      const double middle = out.backward_right(cap, b), begin = in.backward_left(cap, middle);
      // Axis velocities matter only above the least of them, since |h'_k| ≤ 1.
      if ((plain = in.plain() && out.plain() && std::max({b, middle, begin}) <= limit_.slowest2)) {
        speed_[c].middle_stop = middle;
        speed_[c].node_stop = b = begin;
      }
      right = left;
      at = cell.station;
    }
    if (!plain) {
      Known nothing;
      const Stop stop = this->stop(c, part, speed_[c + 1].node_stop, nothing);
      speed_[c].middle_stop = stop.middle;
      speed_[c].node_stop = b = stop.node;
    }
  }
}

template <int N>
template <class Done>
[[gnu::noinline]] void SpeedChain<N>::forward(std::size_t first, std::size_t last, const UnsetVector<double>& share,
                                              Done&& done) {
  std::optional<PlainStation<N>> left;
  std::size_t at = none;  // index of that station
  double b = speed_[first].node;
  for (std::size_t c = first; c < last; ++c) {
    const GridCell& cell = grid_.cells[c];
    bool plain = cell.regular() && !reserve_;
    if (plain) {
      const Station<N>* station = &grid_.stations[cell.station];
      if (at != cell.station) left.emplace(station[0], limit_);
      const PlainStation<N> right(station[1], limit_);
      const double h = station[1].s - station[0].s;
      const PlainLink<N> in(*left, h, share[c]), out(right, h, share[c]);
      if ((plain = in.plain() && out.plain())) {
        speed_[c].middle = in.forward_left(b, speed_[c].middle_stop);
        speed_[c + 1].node = b = out.forward_right(speed_[c].middle, speed_[c + 1].node_stop);
      }
      left = right;
      at = cell.station + 1;
    }
    if (!plain) {
      Known nothing;
      b = step_forward(c, share[c], nothing);
    }
    done(c);
  }
}

extern template class SpeedChain<2>;
extern template class SpeedChain<3>;
extern template class SpeedChain<5>;
extern template class SpeedChain<8>;

}  // namespace bahnwerk
