#pragma once
/// Which sections to slow down, and how far, so that the coarse axes can follow: what gains most for infeasible
/// stretches for the least time.
///
/// A lower feed lengthens those cells of a section in which the head is faster than it; a lower acceleration of a
/// straight move those near its begin or end. What that gains on a stretch is known per unit of time (Cluster::gain),
/// and for velocities out of reach by how much the head gets slower. Feeds and accelerations fall step by step, always
/// that whose next step gains most per unit of time; what would make a straight move slower than its coarse axes alone
/// only where little else helps.
#include <cstddef>
#include <map>
#include <vector>

#include "core/motion/law/time_law.hpp"
#include "core/redundant/clusters.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/head_cells.hpp"
#include "core/redundant/straight_move.hpp"

namespace bahnwerk {

/// How fast the head may go.
struct SectionLimits {
  std::vector<double> feeds;  ///< per segment of the path, mm/s
  struct Straight {
    StraightMove move;
    Pace pace;
    bool slowed = false;
  };
  std::map<std::size_t, Straight> straight;  ///< by segment; their feeds are not those above
  /// Share of the accelerations that other sections are planned with, by their first segment; 1 where there is none.
  std::map<std::size_t, double> acceleration_share = {};
};

/// Lowers section_limits for one stretch of axis `axis`; never raises one. `cluster` is of the chain of the cells.
/// `relaxation_factor` ≥ 1 multiplies the need. Where nothing is known to help, and with a relaxation_factor above 30,
/// all sections of the stretch get slower by a fifth. O(cells · steps).
template <std::size_t order>
void lower_section_limits(const TimeLaw& law, const HeadCells& head, std::size_t axis, const CoarseFineAxis& limits,
                          const Cluster<order>& cluster, double relaxation_factor, SectionLimits& section_limits);

extern template void lower_section_limits(const TimeLaw&, const HeadCells&, std::size_t, const CoarseFineAxis&,
                                          const Cluster<2>&, double, SectionLimits&);
extern template void lower_section_limits(const TimeLaw&, const HeadCells&, std::size_t, const CoarseFineAxis&,
                                          const Cluster<3>&, double, SectionLimits&);

}  // namespace bahnwerk
