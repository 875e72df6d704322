#pragma once
/// What the limits leave to the feed, and the feed below it, as SVG [Herrmann Fig. 4.35].
#include <string>

#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk {

/// Over the arc length of the first turn: per axis the largest constant speed min(V/|q′|, √(A/|q″|), ∛(J/|q‴|)), dashed
/// what the feed's own limits allow, and the feed as planned. Curves are cut off above the largest feed. The feed may
/// exceed an axis's curve where it changes: q″v² and q′a may have opposite signs.
std::string feed_drawing(const WindingRequest& request, const WindingPlan& plan);

}  // namespace bahnwerk
