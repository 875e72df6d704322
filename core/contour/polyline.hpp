#pragma once
/// A contour from points, joined by straight lines.
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"

namespace bahnwerk {

/// Returns one cut block. Points closer than min_segment_length to the last point used are dropped with a note. Throws
/// InvalidInput with places like {"contour","points","7"}. O(n), about 0.2 µs per point; asks `progress` every few
/// thousand points.
Contour polyline(std::size_t dimension, const std::vector<Vec>& points, bool closed, double feed,
                 Progress progress = {});

}  // namespace bahnwerk
