#pragma once
/// Limits of the feed of each segment by the path's curvature κ [Herrmann (4.71)–(4.73)].
///
/// Chord error: setpoints of a cycle T lie on the path, and the chord between two of them is within a tolerance ε of it
/// if the tool covers at most the chord of an arc with curvature κ and sagitta ε per cycle,
///     v_ε = 2/T √(2 ε/κ − ε²)                                                                     (4.71)
/// for ε κ ≤ 1; a larger ε is taken as 1/κ. The distance covered is at least the chord, and a curve stays as close to
/// its chord as an arc of its largest curvature and its length, so the limit also holds where κ changes.
///
/// Half speed: v_κ = κ̂/(κ̂ + κ) v_max, half of v_max at curvature κ̂                                  (4.72)
///
/// The smaller feed at the largest κ of a segment counts (4.73).
#include <vector>

#include "core/geometry/path/path.hpp"
#include "core/machine/limits.hpp"

namespace bahnwerk {

/// The limits from which feeds follow.
struct CurvatureFeedLimits {
  double chord_tolerance = unlimited;       ///< ε, mm
  double cycle_time = 0.001;                ///< T, s
  double half_speed_curvature = unlimited;  ///< κ̂, 1/mm
  double velocity = unlimited;              ///< v_max, mm/s; finite where κ̂ is
};

/// Returns the feed at a curvature in 1/mm, mm/s; infinite where not limited.
double chord_feed(double curvature, const CurvatureFeedLimits& limits);
double half_speed_feed(double curvature, const CurvatureFeedLimits& limits);

/// Returns the largest curvature of a segment, 1/mm: from 16 places per panel and a search around the highest of them,
/// to 1e-9. Infinite at a cusp.
double largest_curvature(const Segment& segment);

/// Returns the smaller of both feeds per segment of the path, mm/s. About 0.1 ms per curved segment.
std::vector<double> curvature_feeds(const Path& path, const CurvatureFeedLimits& limits);

}  // namespace bahnwerk
