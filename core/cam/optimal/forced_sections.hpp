#pragma once
/// Sections that their limits leave one law alone: a monotone section between equal positions is constant, and one
/// whose limit of velocity is its mean velocity is straight. Programs with rows for such limits would have no interior.
#include "core/cam/optimal/law_task.hpp"

namespace bahnwerk::cam {

/// Finds what limits of velocity and ranges of positions say of the positions at points, from section to section. Makes
/// a condition of each position that only one value is left for, a limit that is a number of the velocity of each
/// section with one law, whose other limits that this law keeps are removed, and conditions of the higher derivatives
/// that its neighbours share with it. What cannot hold is left as it is. O(sections²).
void fix_forced_sections(LawTask& task);

}  // namespace bahnwerk::cam
