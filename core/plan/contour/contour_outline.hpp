#pragma once
/// A contour before it is planned: its shape in few points, and an estimate of its duration.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// A polyline of few vertices.
struct Outline {
  std::vector<Vec> vertices;
  std::vector<bool> cut;  ///< whether something is cut on the edge that ends at this vertex; false for the first one
  double tolerance = 0;   ///< mm; every point of the contour lies within it of the polyline
};

/// Returns the outline with at most `most` ≥ 2 vertices: the tolerance is 1e-4 of the contour's size and is doubled
/// until it suffices. Vertices stand where cutting begins and ends, as long as these are fewer than half of `most`.
/// O(segments) per doubling; asks `progress` every 4096 segments.
Outline outline(const Contour& contour, std::size_t most, Progress progress);

/// Returns the outline of a polyline, all of it cut.
Outline outline(const std::vector<Vec>& points, std::size_t most, Progress progress);

struct DurationEstimate {
  double cut_time = 0, position_time = 0;  ///< s, dwells included
};
/// Returns the time of a motion that accelerates and brakes within every segment as its chord permits, holds feeds and,
/// by the sharpest bend between a segment's ends, the acceleration across; it rests in corners of more than
/// `corner_angle` rad. `axes` follow the contour, with the limits of `machine`. Jerk limits are not counted. Within
/// about a fifth of the plan of minimum time. O(segments).
DurationEstimate estimate_duration(const Contour& contour, const AxisPath& axes, const Machine& machine,
                                   double corner_angle, Progress progress);

}  // namespace bahnwerk
