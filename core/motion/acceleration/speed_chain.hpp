#pragma once
/// The largest v² along one section: the chain b0 g0 b1 g1 … (core/motion/acceleration/reach.hpp) solved by one
/// backward and one forward pass.
///
/// Backward: the largest v² from which the rest of the section can still be driven. Forward: from rest, the largest v²
/// below that. Links are polygons around the origin, so what the backward pass allows the forward pass finds. After
/// some cells change, only what they influence is solved again. Cost: O(cells); four divisions per axis and cell, and
/// two small linear programs where an axis turns round (core/motion/acceleration/station_limits.hpp).
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
  /// `reserve` is K_b of [Bock (2.11)], if a braking reserve is kept.
  SpeedChain(const Grid<N>& grid, const std::vector<double>& feed, const Sections& sections, const Machine& machine,
             std::optional<double> reserve);

  /// Takes the grid as it is now, entered at speed² `entry` (0: at rest).
  void start(double entry);
  /// What can still stop, for cells [first, last); to be called for all of them from the last on. share(c) is the part
  /// of the acceleration limits that cell c may use.
  template <class Share>
  void backward(std::size_t first, std::size_t last, Share&& share);
  /// The law of cells [first, last), to be called for all of them from the first on. done(c) is called for each as soon
  /// as its speeds are known: each speed depends on the one before, so what the caller does with them costs little in
  /// between.
  template <class Done>
  void forward(std::size_t first, std::size_t last, const UnsetVector<double>& share, Done&& done);
  /// The motion comes to rest at the end of the grid. The first cell from the right that would be driven the same if it
  /// did not: nothing behind the grid changes the law up to there. 0 if there is none.
  std::size_t unaffected(const UnsetVector<double>& share) const;
  /// Whether the law is slightly below what can still stop at cell c: then its speed there comes from before.
  bool slack(std::size_t c) const { return speed_[c].node < speed_[c].node_stop * (1 - 1e-4); }
  /// Whether cell c is driven at constant speed.
  bool steady(std::size_t c) const {
    return speed_[c].node == speed_[c].middle && speed_[c].node == speed_[c + 1].node;
  }
  /// Whether the entry is not too fast.
  bool enters() const { return entry_ <= speed_[0].node_stop * (1 + 1e-12); }
  /// The grid's cells have been divided so: to be followed by an update in which every part of a divided cell is dirty.
  void divided(const LargeVector<std::uint8_t>& parts, ProgressScope& pulse);
  /// Solves again where `dirty` cells (1) have a new share, and marks in `dirty` every cell whose speeds changed.
  void update(const UnsetVector<double>& share, CellFlags& dirty, ProgressScope& pulse);

  double node(std::size_t c) const { return speed_[c].node; }      ///< v² at the left end of cell c, mm²/s²
  double middle(std::size_t c) const { return speed_[c].middle; }  ///< its middle Bernstein coefficient
  double acceleration(std::size_t c) const;                   ///< what a straight cell allows along the path, mm/s²
  double cap(std::size_t c) const { return caps(c).middle; }  ///< v² that a straight cell may hold

 private:
  static constexpr std::size_t none = -1;
  struct Caps {
    double left, middle, right;  // on v², of what needs no neighbour; of a straight cell's middle: of all of it
  };
  Caps caps(std::size_t c) const;
  double first_cap(std::size_t c, double cap) const;
  /// At a cusp the curvature is unbounded while v² κ → 0: half of the limit is kept in reserve there.
  double left_part(std::size_t c) const {
    return grid_.cells[c].any_way ? any_way(grid_.left(c)) : grid_.cells[c].cusp_left ? 0.5 : 1;
  }
  double right_part(std::size_t c) const {
    return grid_.cells[c].any_way ? any_way(grid_.right(c)) : grid_.cells[c].cusp_right ? 0.5 : 1;
  }
  /// The part of the limits with which half of the least acceleration goes along the path: in a needle point the path
  /// turns through any direction while it bends, and together that takes 1.3 times the acceleration along it.
  double any_way(const Station<N>& at) const {
    return 0.5 * largest(magnitude(at.d1) * limit_.inverse_acceleration) / largest(limit_.inverse_acceleration);
  }
  Rows<N> rows_left(std::size_t c, double share, bool flip) const;
  Rows<N> rows_right(std::size_t c, double share, bool flip) const;
  Rows<N> link(const Station<N>& at, double h, double share, bool flip, std::size_t segment) const;
  /// Where links are not plain: by search.
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
  /// `right`: what is known of the cell's right station; of its left one afterwards.
  Stop stop(std::size_t c, double share, double& next, Known& right) const;
  Stop step_back(std::size_t c, double share, const Caps& cap, double next, Known& right) const;
  /// `left`: what is known of the cell's left station; of its right one afterwards.
  double step_forward(std::size_t c, double share, Known& left);
  double right_cap(std::size_t c, double speed2) const;

  const Grid<N>& grid_;
  const std::vector<double>& feed_;
  const Sections& sections_;
  std::optional<double> reserve_;
  AxisBounds<N> limit_;
  double entry_ = 0;  // v² at the begin
  double max_ = 0;    // v² that the section's length allows
  /// v² at the left end of a cell and its middle coefficient: what can still stop, and the law.
  struct Speeds {
    double node_stop, middle_stop, node, middle;
  };
  UnsetVector<Speeds> speed_;  // one more than cells
};

template <int N>
template <class Share>
[[gnu::noinline]] void SpeedChain<N>::backward(std::size_t first, std::size_t last, Share&& share) {
  std::optional<PlainStation<N>> right;
  std::size_t at = none;  // the station which that is
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
        // What this cell's caps take from the node at its right may be taken afterwards: the links are convex and hold
        // the origin.
        speed_[c + 1].node_stop = b = std::min(b, cap);
      }
      const PlainStation<N> left(station[0], limit_);
      const PlainLink<N> in(left, h, part), out(*right, h, part);
      const double middle = out.backward_right(cap, b), begin = in.backward_left(cap, middle);
      // Axis velocities matter above the least of them only: |h'_k| ≤ 1.
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
  std::size_t at = none;  // the station which that is
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
