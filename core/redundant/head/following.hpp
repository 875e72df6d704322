#pragma once
/// The chain (chain.hpp) of one coarse axis that follows a given head motion: its boxes express the limits of the
/// coarse axis and, since the fine axis makes up for the rest (x_f = x − x_c), those of the fine axis.
///
/// The coarse acceleration is constant in a cell (order 2) or linear (order 3). The boxes hold at nodes only, so they
/// are reduced by the largest excess that the motion can have between nodes. For a cell of duration h in which the
/// head's acceleration lies in a range of width w, the fine velocity exceeds its values at the nodes by at most w·h/4,
/// the fine position by A_f·h²/8, the coarse position by A_c·h²/8, and (order 3, w being the range of the head's jerk)
/// the fine acceleration by w·h/4. For order 3 both velocities exceed their values
/// by at most min(J_c·h²/8, A_c·h/4). Where the head's velocity or acceleration jumps at a node, the values on both
/// sides count.
#include <cstddef>
#include <optional>

#include "core/redundant/chain/chain.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/head/head_cells.hpp"

namespace bahnwerk {

/// The units that make the chain of an axis dimensionless.
struct ChainUnits {
  double length = 1;  ///< mm: the stroke
  double time = 1;    ///< s: √(stroke/coarse acceleration)
  double velocity() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double jerk() const { return length / (time * time * time); }
};
/// Returns the units for an axis with a stroke above 0.
ChainUnits chain_units(const CoarseFineAxis& axis);

/// Returns the chain of axis `axis` with one cell per cell of `head`, whose times are first multiplied by `stretch` ≥
/// 1; none if the head exceeds the sum of the limits by more than rounding.
template <std::size_t order>
std::optional<Chain<order>> following(const HeadCells& head, std::size_t axis, const CoarseFineAxis& limits,
                                      double stretch = 1);

extern template std::optional<Chain<2>> following(const HeadCells&, std::size_t, const CoarseFineAxis&, double);
extern template std::optional<Chain<3>> following(const HeadCells&, std::size_t, const CoarseFineAxis&, double);

}  // namespace bahnwerk
