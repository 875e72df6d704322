#pragma once
/// Where a motion that may take longer should be slower, for the sake of the coarse axes' energy ∫a².
///
/// About: the coarse axes do not rest where the head does. The energy E of what lies between two rests falls with the
/// cube of how many times as long it lasts, s; Σ E/s³ is least for a given Σ T s where s⁴ is as E/T, and 1 at least.
#include <vector>

#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

struct SlowedByEnergy {
  std::vector<TimeLaw::Slowing> slowings;  ///< of what lies between two rests; none where there is no energy
  double energy = 1;                       ///< what that leaves of it, about, over what slowing evenly would
};

/// So that the whole lasts `duration` s, no part more than 16 times as long as it does. `times`: of the nodes
/// between cells, both ends included, s; `energies`: of each cell, in any unit. O(pieces + cells).
SlowedByEnergy slowed_by_energy(const TimeLaw& law, const std::vector<double>& times,
                                const std::vector<double>& energies, double duration);

}  // namespace bahnwerk
