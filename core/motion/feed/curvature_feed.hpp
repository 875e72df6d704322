#pragma once
/// How the path's curvature κ limits the feed of each of its segments [Herrmann (4.71)–(4.73)].
///
/// Chord error: setpoints of a cycle T lie on the path, and so does what is between them only to within a tolerance ε,
/// if from one to the next the tool goes no more than the chord of an arc with curvature κ and sagitta ε,
///     v_ε = 2/T √(2 ε/κ − ε²)                                                                     (4.71)
/// for ε κ ≤ 1; a larger ε is taken as 1/κ. As the way is at least the chord, this is on the safe side, and as a curve
/// strays no further from its chord than an arc of its largest curvature and its length, it holds where κ changes.
///
/// Half speed: v_κ = κ̂/(κ̂ + κ) v_max, half of v_max at curvature κ̂                                  (4.72)
///
/// Of a segment, with its largest κ, the smaller one counts (4.73).
#include <vector>

#include "core/geometry/path/path.hpp"
#include "core/machine/limits.hpp"

namespace bahnwerk {

struct CurvatureFeedLimits {
  double chord_tolerance = unlimited;       ///< ε, mm
  double cycle_time = 0.001;                ///< T, s
  double half_speed_curvature = unlimited;  ///< κ̂, 1/mm
  double velocity = unlimited;              ///< v_max, mm/s; finite where κ̂ is
};

/// mm/s at a curvature in 1/mm; infinite where not limited.
double chord_feed(double curvature, const CurvatureFeedLimits& limits);
double half_speed_feed(double curvature, const CurvatureFeedLimits& limits);

/// The largest curvature of a segment, 1/mm: at 16 places per panel and at the highest place around the highest of
/// them, to 1e-9. Infinite at a cusp.
double largest_curvature(const Segment& segment);

/// Per segment of the path: the smaller one of both feeds, mm/s. About 0.1 ms per curved segment.
std::vector<double> curvature_feeds(const Path& path, const CurvatureFeedLimits& limits);

}  // namespace bahnwerk
