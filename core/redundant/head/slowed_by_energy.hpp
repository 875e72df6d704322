#pragma once
/// Distribution of additional time over the parts of a motion between rests, so that the coarse axes' energy ∫a² falls
/// most.
///
/// If a part lasts s times as long, its energy E becomes E/s³. Σ E/s³ is least for a given total duration Σ T s if s⁴
/// is proportional to E/T, where s ≥ 1. This is an estimate, because the coarse axes do not rest where the head does.
#include <vector>

#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

struct SlowedByEnergy {
  std::vector<TimeLaw::Slowing> slowings;  ///< one per part between two rests; empty if there is no energy
  double energy = 1;                       ///< estimated energy relative to that of even slowing
};

/// Returns the slowing after which the whole motion lasts `duration` s; no part gets longer than 16 times. `times` are
/// the n + 1 nodes of cells, s; `energies` are the energies of the n cells in any unit. O(pieces + cells).
SlowedByEnergy slowed_by_energy(const TimeLaw& law, const std::vector<double>& times,
                                const std::vector<double>& energies, double duration);

}  // namespace bahnwerk
