#pragma once
/// Rounded corners of boundaries.
#include <vector>

#include "core/geometry/region/edge.hpp"

namespace bahnwerk {

/// Rounds the corner between edge `i` of the closed loop and the next one, if it turns left: shortens both and inserts
/// an arc tangent to both. Any other corner stays as it is. Returns false, with the loop unchanged, if the radius does
/// not fit.
bool round_corner(std::vector<Edge>& loop, std::size_t i, double radius);

}  // namespace bahnwerk
