#pragma once
/// The time-optimal problem of one section under jerk limits, on a grid, as the interior-point method (solver.hpp)
/// solves it.
///
/// The unknowns at every inner node are b = v² and the path acceleration a (b′ = 2a). Both end nodes are at rest, or
/// their states are given. The objective is the sum of the cells' durations (cell.hpp). For axis k, with the path's
/// derivatives h′, h″, h‴ by arc length,
///   velocity      h′² b ≤ V²                                   [Bock (2.8)]
///   acceleration  |h″ b + h′ a| ≤ A                            [Bock (2.7), (2.9)]
///   jerk          |h‴ v³ + 3 h″ v a + h′ j| ≤ J                [Bock Def. 2.6], [Herrmann (4.80)]
/// Acceleration is limited at nodes and, where needed, in the middle of cells; jerk at both ends of each cell. Every
/// row is divided by its limit; `share` (near 1) is the usable part of it.
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/motion/jerk/cell.hpp"
#include "core/numeric/lanes.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

/// Derivatives by arc length of M quantities: the axes and, where limited, the path itself (1, 0, 0).
template <int M>
struct JerkStation {
  Lanes<M> d1{}, d2{}, d3{};
};

/// M rows |p b + q a| ≤ share at one node.
template <int M>
struct NodeRows {
  std::size_t node = 0;
  std::array<double, M> p{}, q{}, share{};
};

/// M rows |h″ (b₁ + b₂)/2 + h′ g| / A ≤ share. g = 3 (v₂ − v₁)/T − a₁ − a₂ is the middle Bernstein coefficient of the
/// acceleration, a quadratic of time, so a stays below its limit between the nodes. Without these rows a law at the
/// acceleration limit oscillates in jerk within every cell.
template <int M>
struct MiddleRows {
  std::size_t cell = 0;
  std::array<double, M> d1{}, d2{}, share{};  ///< derivatives in the middle, divided by A; d2 is halved
};

/// The problem of a section with M limited quantities.
template <int M>
struct JerkProblem {
  struct Cell {
    double h = 0;               ///< mm
    std::uint32_t station = 0;  ///< index of the station at the left end; the right end is the next one
    std::array<std::array<double, M>, 2> share{};  ///< shares of the jerk limits at both ends
  };
  LargeVector<JerkStation<M>> stations;
  LargeVector<Cell> cells;
  std::array<double, M> inverse_jerk{};  ///< 1/J, s³/mm; 0 = unlimited
  /// Caps per node, towards the left and the right cell: b ∓ reach · a ≤ cap, stored as 1/cap, s²/mm²; 0 means
  /// unlimited. b ∓ 2/3 h a are the inner Bernstein coefficients of b, a cubic of s, over the cell, so b stays below
  /// its cap between the nodes.
  LargeVector<std::array<double, 2>> inverse_cap;
  LargeVector<std::array<double, 2>> cap_reach;  ///< mm
  LargeVector<NodeRows<M>> nodes;                ///< rows of nodes, in ascending order of nodes
  LargeVector<MiddleRows<M>> middles;            ///< rows inside cells, in ascending order of cells
};

}  // namespace bahnwerk
