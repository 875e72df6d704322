#pragma once
/// A motion as a chain of cells (core/probe/optimal/cell_basis.hpp), and the convex sets and limits that it must keep.
/// Positions are relative to an origin of the caller's choice.
#include <array>
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// D = 1 … 3 axes. Position, velocity, acceleration and jerk: mm, mm/s, mm/s², mm/s³.
template <int D>
struct ChainNode {
  std::array<std::array<double, D>, 4> state{};
  int point = -1;      ///< the point that is passed here, or −1
  bool still = false;  ///< velocity 0 is given: where the head turns back without a tube
  bool given = false;  ///< the whole state is given: at both ends, and where a window begins
};

struct ChainCell {
  double duration = 0;   ///< s
  std::size_t edge = 0;  ///< the cell lies between points `edge` and `edge` + 1
  int level = 0;         ///< number of times it was halved
};

/// nodes = cells + 1; cell k leads from node k to node k + 1.
template <int D>
struct CellChain {
  std::vector<ChainNode<D>> node;
  std::vector<ChainCell> cell;
  double duration() const {
    double sum = 0;
    for (const ChainCell& c : cell) sum += c.duration;
    return sum;
  }
};

template <int D>
struct ChainLimits {
  std::vector<std::array<double, D>> points;
  double tolerance = 0;      ///< radius of the capsules around the edges, mm; 0: unlimited
  std::vector<double> tube;  ///< radius per edge, mm, where tolerance > 0 and the edges differ; else empty
  std::vector<double> ball;  ///< radius of the ball of each point that is passed, mm; 0: the point itself is passed
  /// A smooth curve near the points: each point's parameter, about the length, and the derivatives of orders 1 to 3 of
  /// the curve there, 0 where there is none. Empty: no curve is known.
  std::vector<double> along;
  std::vector<std::array<std::array<double, D>, 3>> curve;
  double speed = 0;                                   ///< Euclidean, mm/s
  std::array<std::array<double, D>, 3> derivative{};  ///< limits of acceleration, jerk, snap of every axis, mm/s² …
  double radius(std::size_t edge) const { return tube.empty() ? tolerance : tube[edge]; }
};

}  // namespace bahnwerk
