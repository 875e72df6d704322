#pragma once
/// Method `spline` [Thielemann, "2. Ansatz: Basteln"]: a polynomial from point to point, with derivatives at the points
/// that three neighbouring points say.
///
/// Velocity and acceleration at a point are those of the parabola through it and its neighbours; the jerk is
/// the difference quotient of the neighbours' accelerations. Pieces of degree 7 share all of them, so that the jerk is
/// continuous. Times begin with the profile of 15 phases along the whole length. Where points are dense it is followed
/// to the third derivative: parabolas over the length give tangent and curvature, the profile speed, acceleration and
/// jerk along them. Elsewhere times are stretched, smoothly along the path, where speed or a limit is exceeded, and
/// shortened where there is room. Where a piece leaves the tube, velocity (by λ), acceleration (by λ²) and jerk (by λ³)
/// at its ends are reduced, down to a rest. In the end all times between two rests are scaled by the factor that the
/// true peaks require, which leaves the path as it is. From rest to rest along a straight row the profile itself is
/// taken. Between two rests the motion is never slower than with rests at every point, nor than without rests between,
/// where a spline without them was found.
///
/// Where there are more than 2000 points, the head rests wherever a piece leaves the tube in a part that six
/// divisions in turn have left more than half of, and everywhere after ten.
///
/// Cost: O(points log points) at worst, some 50 µs per point and plan.
#include "core/base/progress.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

/// Plans the motion. Throws what progress throws.
ProbeMotion plan_spline(const ProbeProblem& problem, Progress progress);

}  // namespace bahnwerk
