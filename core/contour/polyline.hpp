#pragma once
/// A contour from points, joined by straight lines.
#include <vector>

#include "core/contour/contour.hpp"

namespace bahnwerk {

/// One cut block. Points closer than min_segment_length to the last kept one are dropped with a note. Throws
/// InvalidInput with places like {"contour","points","7"}. O(n).
Contour polyline(std::size_t dimension, const std::vector<Vec>& points, bool closed, double feed);

}  // namespace bahnwerk
