#pragma once
/// The first step of a winding plan: the places of the wires of all coils.
#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk {

/// Share of the job's progress at which coils are laid.
inline constexpr double coils_laid = 0.03;

/// Sets layout, turns and windable of `plan`. The verdict is that of kind fill_factor, on the first 400 wires and on
/// all that are wound. Throws InvalidInput naming wire, coil.parallel or coil.turns where the layout has too few
/// places, feed.law; what slot and regions throw; Stopped. O(n²) for n wires.
void lay_coils(const WindingRequest& request, WindingPlan& plan, Progress progress);

}  // namespace bahnwerk
