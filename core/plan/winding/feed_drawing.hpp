#pragma once
/// Drawing of the feed along a needle's path, and of the largest feed that each axis permits, as SVG [Herrmann Fig.
/// 4.35].
#include <string>

#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk {

/// Returns a chart over the arc length of the first turn: per axis the largest constant speed min(V/|q′|, √(A/|q″|),
/// ∛(J/|q‴|)), dashed the limits of the feed itself, and the planned feed. Curves are cut off above the largest feed.
/// The feed may exceed an axis' curve while it changes, because q″v² and q′a may have opposite signs.
std::string feed_drawing(const WindingRequest& request, const WindingPlan& plan);

}  // namespace bahnwerk
