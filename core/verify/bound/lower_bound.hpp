#pragma once
/// A proven lower bound on the duration of any motion along a contour.
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

struct BoundTask {
  const AxisPath& path;
  const Machine& machine;     ///< as many axes as the path has, in its order
  std::vector<double> feeds;  ///< per segment: speed of the tool, mm/s, infinite where not limited
  std::vector<bool> rests;    ///< per segment, whether the motion rests at its begin; and one for the end of the path
};

/// No motion is shorter that keeps the axes' velocity and acceleration limits and the feeds, rests at both ends, at
/// corners (tangent jump > corner_angle, rad), at cusps and, as long as asked, at the contour's rests, and passes every
/// other joint with |Δt_k| v ≤ A_k · cycle time in every axis. Jerk limits count on runs that are one straight segment
/// (closed form); elsewhere they are left out, which can only lower the bound. Acceleration limits must be finite.
/// `gap` is left 0: see with_gap.
///
/// The argument. With b = v² and h the path by arc length, axis k moves with ẋ_k = h'_k v and d(h'_k² b)/ds = 2 h'_k
/// ẍ_k. Hence between two places between which x_k is monotone, h'_k² b changes by at most 2 A_k |Δx_k|: exact, however
/// far apart they are. Nodes stand where some h'_k = 0, at both sides of joints, and at most 0.02 rad apart. At each
/// node b is capped by velocity, feed, rest, and by the largest b for which a path acceleration exists at all: |h'_m
/// h''_k − h'_k h''_m| b ≤ A_k |h'_m| + A_m |h'_k|. The largest b at the nodes under these conditions, found in one
/// forward and one backward pass, is not exceeded by any motion at any node. Each cell then takes at least the time
/// that its slowest single axis needs to travel |Δx_k| between these end speeds (accelerate, cruise, brake: closed
/// form), and at least length / feed. There is no quadrature and no discretisation error in this chain; a finer grid
/// only tightens it. Cells in which the binding condition changes are quartered until the bound changes by less than
/// 3e-7.
///
/// What is not proven but computed: that x_k is monotone in a cell rests on the signs of h'_k at its ends (cells are
/// halved where turn, chord or curvature say that the ends do not tell all); that h'_k leaves the range of its ends by
/// no more than the cell turns; and rounding of positions, tangents and curvatures, for which every condition is used
/// in its weaker reading and the sum is reduced by 1e-12 + 4e-16 per node. Distance to the true optimum: exact on
/// polylines; ≤ 5e-6 beyond the reference's own error on 3,000 random contours of arcs, lines and rational pieces (held
/// to 2e-5 by tests against a dense solution). Cost: ≈ 85 ns per node on lines, 300–600 ns on arcs and free-form
/// curves, O(n) time and ≈ 0.4 kB per node between two rests, of at most 200,000
/// segments (at such a cut the speed is left open). Calls progress every few ms; throws what it throws.
Bound lower_bound(const BoundTask& task, double corner_angle, Progress& progress, double progress_from = 0,
                  double progress_to = 1);

/// The same for a contour on a Cartesian machine, with the contour's dwells.
Bound lower_bound(const Contour& contour, const Machine& machine, double corner_angle, Progress& progress,
                  double progress_from = 0, double progress_to = 1);

/// Completes a bound: gap = planned / duration − 1. Negative only if the plan really is shorter than the bound by more
/// than rounding.
Bound with_gap(Bound bound, double planned);

/// Check "bound", s: `value` is the bound, `limit` the planned duration. A plan that is shorter than its bound by more
/// than 1e-9 of itself does not pass: one of the two is wrong.
Check bound_check(const Bound& bound, double planned);

}  // namespace bahnwerk
