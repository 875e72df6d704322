#pragma once
/// The first step of a winding plan: the places of the wires of all coils, and the support points of the needle's tip.
#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk {

/// Share of the job's progress at which coils are laid.
inline constexpr double coils_laid = 0.05;

/// Sets layout, turns, windable and support of `plan`. The verdict is that of kind fill_factor, on the first 400 wires
/// and on all that are wound. Throws InvalidInput naming wire, coil.parallel or coil.turns where the layout has too few
/// places, feed.law, needle.length or machine.l_tool where the tip goes deeper into the slot than they are long; what
/// slot, regions and support points throw; Stopped. O(n²) for n wires, some ms per turn.
void lay_coils(const WindingRequest& request, WindingPlan& plan, Progress& progress);

}  // namespace bahnwerk
