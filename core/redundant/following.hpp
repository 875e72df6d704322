#pragma once
/// A coarse axis that follows the head so closely that the fine one makes up for the rest: the chain whose boxes hold
/// the limits of both, in the chain's own units.
///
/// In a cell the coarse acceleration is constant (order 2) or linear (order 3), so what the head does between its nodes
/// is the only thing that boxes have to leave room for: with the head's acceleration within a range of width w in a
/// cell of h seconds the fine velocity is at most w·h/4 beyond what it is at the nodes, the fine position at most
/// A_f·h²/8, the coarse one at most A_c·h²/8 beyond the nodes', the fine acceleration (its jerk's range of width w) at
/// most w·h/4; with order 3 both velocities lie at most J_c·h²/8, and A_c·h/4, beyond. Where the head's velocity or
/// acceleration jumps at a node what it is on either side counts.
#include <cstddef>

#include "core/redundant/chain.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/head_cells.hpp"

namespace bahnwerk {

/// The units in which the chain of an axis is solved.
struct ChainUnits {
  double length = 1;  ///< mm: the stroke
  double time = 1;    ///< s: √(stroke/coarse acceleration)
  double velocity() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double jerk() const { return length / (time * time * time); }
};
ChainUnits chain_units(const CoarseFineAxis& axis);

/// Returns the boxes of axis `axis`. The head is slowed to last `stretch` ≥ 1 times as long. Throws Infeasible where
/// the head exceeds the sum of the limits by more than rounding.
template <std::size_t order>
Chain<order> following(const HeadCells& head, std::size_t axis, const CoarseFineAxis& limits, double stretch = 1);

extern template Chain<2> following(const HeadCells&, std::size_t, const CoarseFineAxis&, double);
extern template Chain<3> following(const HeadCells&, std::size_t, const CoarseFineAxis&, double);

}  // namespace bahnwerk
