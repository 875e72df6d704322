#pragma once
/// Chooses which sections of a head become slower, and by how much, so that an infeasible interval of a coarse axis'
/// chain becomes feasible with the least additional time.
///
/// A lower feed lengthens the cells in which the head is faster than that feed; a lower acceleration of a straight move
/// lengthens the cells near its ends. The gain per unit of time of each cell is known (Cluster::gain); for velocities
/// out of reach it is the decrease of the head's speed. Limits fall in steps, and each step lowers the limit with the
/// largest gain per unit of time. A step that would make a straight move slower than its coarse axes alone is only
/// taken where little else helps.
#include <cstddef>
#include <map>
#include <vector>

#include "core/motion/law/time_law.hpp"
#include "core/redundant/chain/clusters.hpp"
#include "core/redundant/coarse/straight_move.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/head/head_cells.hpp"

namespace bahnwerk {

/// Speed and acceleration limits of the head, section by section.
struct SectionLimits {
  std::vector<double> feeds;  ///< per segment of the path, mm/s
  struct Straight {
    StraightMove move;
    Pace pace;
    bool slowed = false;
  };
  std::map<std::size_t, Straight> straight;  ///< by segment; `feeds` does not apply to these
  /// Share of the accelerations that other sections are planned with, by first segment; 1 if there is no entry.
  std::map<std::size_t, double> acceleration_share = {};
};

/// An infeasible interval of an axis' chain. Limits and interval have to outlive the object.
template <std::size_t order>
struct InfeasibleInterval {
  std::size_t axis;
  const CoarseFineAxis& limits;  ///< limits of the axis
  const Cluster<order>& cluster;
};

/// Lowers `section_limits` for one infeasible interval of a chain; never raises a limit. `law` is the head's law and
/// `head` are its cells. `relaxation_factor` ≥ 1 multiplies the required gain. If no limit is known to help, or
/// `relaxation_factor` exceeds 30, all sections of the interval become slower by a fifth. O(cells · steps).
template <std::size_t order>
void lower_section_limits(const TimeLaw& law, const HeadCells& head, const InfeasibleInterval<order>& interval,
                          double relaxation_factor, SectionLimits& section_limits);

extern template void lower_section_limits(const TimeLaw&, const HeadCells&, const InfeasibleInterval<2>&, double,
                                          SectionLimits&);
extern template void lower_section_limits(const TimeLaw&, const HeadCells&, const InfeasibleInterval<3>&, double,
                                          SectionLimits&);

}  // namespace bahnwerk
