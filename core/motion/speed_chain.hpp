#pragma once
/// The largest v² along one run: the chain b0 g0 b1 g1 … (core/motion/reach.hpp) solved by one backward and one forward
/// pass.
///
/// Backward: the largest v² from which the rest of the run can still be driven. Forward: from rest, the largest v²
/// below that. Links are polygons around the origin, so what the backward pass allows the forward pass finds. After
/// some cells change, only what they influence is solved again. Cost: O(cells); two small linear programs and two
/// divisions per axis and cell.
#include <cstdint>
#include <optional>
#include <vector>

#include "core/contour/contour.hpp"
#include "core/motion/grid.hpp"
#include "core/motion/pulse.hpp"
#include "core/motion/runs.hpp"
#include "core/motion/station_limits.hpp"

namespace bahnwerk {

template <int N>
class SpeedChain {
 public:
  /// `reserve` is K_b of [Bock (2.11)], if a braking reserve is kept.
  SpeedChain(const Grid<N>& grid, const std::vector<double>& feed, const Runs& runs, const Machine& machine,
             std::optional<double> reserve);

  /// Takes the grid as it is now, entered at speed² `entry` (0: at rest).
  void start(double entry);
  /// What can still stop, for cells [first, last); to be called for all of them from the last on. `share` is the part
  /// of the acceleration limits that each cell may use.
  void backward(std::size_t first, std::size_t last, const LargeVector<double>& share);
  /// The law of cells [first, last), to be called for all of them from the first on.
  void forward(std::size_t first, std::size_t last, const LargeVector<double>& share);
  /// The motion comes to rest at the end of the grid. The first cell from the right that would be driven the same if it
  /// did not: nothing behind the grid changes the law up to there. 0 if there is none.
  std::size_t unaffected(const LargeVector<double>& share) const;
  /// Whether the law is below what can still stop at cell c, by a hair: then its speed there comes from before.
  bool slack(std::size_t c) const { return node_[c] < node_stop_[c] * (1 - 1e-4); }
  /// Whether the entry is not too fast.
  bool enters() const { return entry_ <= node_stop_[0] * (1 + 1e-12); }
  /// Solves again where `dirty` cells (1) have a new share, and marks in `dirty` every cell whose speeds changed.
  void update(const LargeVector<double>& share, LargeVector<std::uint8_t>& dirty, PlanningPulse& pulse);

  double node(std::size_t c) const { return node_[c]; }       ///< v² at the left end of cell c, mm²/s²
  double middle(std::size_t c) const { return middle_[c]; }   ///< its middle Bernstein coefficient
  double acceleration(std::size_t c) const;                   ///< what a straight cell allows along the path, mm/s²
  double cap(std::size_t c) const { return caps(c).middle; }  ///< v² that a straight cell may hold

 private:
  struct Caps {
    double left, middle, right;  // on v², of what needs no neighbour; of a straight cell's middle: of all of it
  };
  Caps caps(std::size_t c) const;
  double first_cap(std::size_t c, double cap) const;
  /// At a cusp the curvature is unbounded while v² κ → 0: half of the limit is kept in reserve there.
  double left_part(std::size_t c) const { return grid_.cells[c].cusp_left ? 0.5 : 1; }
  double right_part(std::size_t c) const { return grid_.cells[c].cusp_right ? 0.5 : 1; }
  Rows<N> rows_left(std::size_t c, double share, bool flip) const;
  Rows<N> rows_right(std::size_t c, double share, bool flip) const;
  Rows<N> link(const Station<N>& at, double h, double share, bool flip, std::size_t segment) const;
  struct Stop {
    double middle, node;
  };
  Stop stop(std::size_t c, double share, double& next) const;
  Stop step_back(std::size_t c, double share, const Caps& cap, double next) const;
  void step_forward(std::size_t c, double share);

  const Grid<N>& grid_;
  const std::vector<double>& feed_;
  const Runs& runs_;
  std::optional<double> reserve_;
  AxisBounds<N> limit_;
  double entry_ = 0;                             // v² at the begin
  double most_ = 0;                              // v² that the run's length allows
  LargeVector<double> node_stop_, middle_stop_;  // what can still stop
  LargeVector<double> node_, middle_;            // the law
};

extern template class SpeedChain<2>;
extern template class SpeedChain<3>;

}  // namespace bahnwerk
