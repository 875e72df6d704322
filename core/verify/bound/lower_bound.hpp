#pragma once
/// A proven lower bound on the duration of any motion along a contour.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/motion/axes/path_task.hpp"

namespace bahnwerk {

/// Least duration of the path's segments [first, last) between two rests, s; without dwells.
struct SectionBound {
  std::size_t first = 0, last = 0;
  double duration = 0;
};

/// Returns a duration that no motion falls below which keeps the axes' velocity and acceleration limits and the feeds,
/// rests at both ends, at corners (jump of the tool's tangent > corner_angle, rad), at cusps and at the task's rests,
/// passes every other joint with |Δq'_k| v ≤ A_k · cycle time in every axis, and, where jerk is limited, with a step of
/// its acceleration of at most J_k · cycle time. Limits of jerk count in closed form on sections that are one linear
/// segment, elsewhere by duality (core/verify/bound/jerk_bound.hpp). Acceleration limits must be finite. `gap` is left
/// 0: see with_gap.
///
/// The argument: with b = v² and q the axes over the arc length s of the tool's path, axis k moves with q̇_k = q'_k v
/// and d(q'_k² b)/ds = 2 q'_k q̈_k. Hence between any two places q'_k² b changes by at most 2 A_k ∫|q'_k| ds, exactly,
/// however far apart they are, and by 2 A_k |Δq_k| if q_k is monotone. Nodes stand where some q'_k = 0, on both sides
/// of joints, and where q' has turned by 0.02. At each node b is capped by velocity, feed, rest, and by the largest b
/// for which a path acceleration exists at all: |q'_m q''_k − q'_k q''_m| b ≤ A_k |q'_m| + A_m |q'_k|. The largest b at
/// the nodes under these conditions, found in one forward and one backward pass, is not exceeded by any motion at any
/// node. Each cell then takes at least the time that its slowest single axis needs to travel |Δq_k| between these end
/// speeds (accelerate, cruise, brake: closed form; an axis that reverses travels further), and at least length / feed.
/// There is no quadrature and no discretisation error in this chain; a finer grid only tightens it. Cells in which the
/// binding condition changes are quartered until the bound changes by less than 3e-7; before that those between whose
/// nodes the caps have a minimum (by a parabola through three samples) where b reaches half of them or more. Each time
/// only the surroundings of the new nodes are solved again (core/verify/bound/bound_solver.hpp). A section that is an
/// earlier one at another place has that one's bound, less a margin for rounding
/// (core/verify/bound/repeated_section.hpp). Only the task is needed: bound and plan may be computed at the same time.
///
/// Enclosures: two figures of a cell depend on the range of q' between its nodes: the energy 2 A_k ∫|q'_k| ds, and the
/// largest speed of an axis there, from the least |q'| of the others and its own largest. Both follow from an interval
/// that contains q'_k throughout the cell (core/verify/bound/direction_range.hpp), and ∫|q'_k| ds ≤ |Δq_k| + 2 length ·
/// (the part of the interval with the wrong sign). The interval is computed
///   - for linear segments: exactly;
///   - for arcs and helices: from values and slopes at both ends and the exact |q'''|;
///   - for rational curves: from the Taylor coefficients of the polynomial N' w − N w' about the middle of the cell,
///     which bound its components and the cone that contains it (core/verify/bound/hodograph.hpp);
///   - for axes through kinematics: from the values at both ends where q''_k keeps its sign, else from values and
///     slopes there and a bound of |q'''_k|. The machine's formula over discs encloses q'_k, q''_k and q'''_k
///     (AxisPath::enclose, core/numeric/disc.hpp). For machines without a formula |q'''_k| is at most
///     B₃ + 3 B₂ |h''| + B₁ |h'''|, with the MapBounds B of the machine (taken as true).
/// Conditions of axes through kinematics that stand still but for rounding (largest_rates) are dropped. Cells for which
/// a wrong sign of more than 1e-6 cannot be excluded are halved, at most 12 times; the rest counts. The width of other
/// cells depends on samples, which affects the tightness of the bound, not its validity.
///
/// Estimated, not enclosed, are: rounding of positions, q', q'' and s at the nodes, and of the kinematics' map, with
/// margins from the magnitudes of the summands (every condition is used in its weaker form; the sum is reduced by 1e-12
/// + 4e-16 per node); the table of the arc length (some 1e-15 of it); pieces that count as straight (they lie within
/// 1e-12 of their size on a line); the expansion next to a vanishing parametric tangent.
///
/// Distance to the true optimum: exact on polylines; ≤ 5e-6 beyond the reference's own error on 3,000 random contours
/// of arcs, lines and rational pieces (held to 2e-5 by tests against a dense solution); within 8e-6 of the planner's
/// duration on a made-up machine with five axes (held to 1e-4). With limits of jerk it is mostly 0.05 to 2 %, on
/// needle paths 0.7 to 1.2 % (docs/methods/winding_path.md). Cost: 90 ns per
/// line between corners, 170–340 ns per node on arcs, 350–600 ns on free-form curves, O(n) time; with limits of
/// jerk 2 to 4 µs per cell of theirs more.
///
/// Long paths. A section of more than 4096 segments whose first grid has more than some 100,000 nodes (through
/// kinematics 384 and 90,000) is solved in windows of so many (256 and 60,000) and a 16th more (a quarter where they
/// are straight), which are left open behind; the next window begins as fast as that one may be there. So memory is
/// that of a window, ≈ 0.25 kB per node of two axes, 0.4 kB of five. Limits of jerk see each window alone, free at its
/// ends: on needle paths each window costs 15 to 20 ms of the bound. Paths that would need more than 250,000 nodes to
/// begin with get wider cells, up to 8 times, and are refined less: the bound then lies up to 1e-4 below what it would
/// be.
///
/// Reports to `progress` every few ms and passes its exceptions on; throws UnreachablePose. `sections`, if given,
/// receives the bounds of the sections, in order, whose sum (and the dwells) is the bound.
Bound lower_bound(const PathTask& task, double corner_angle, Progress progress,
                  std::vector<SectionBound>* sections = nullptr);

/// Computes the bound of a contour on a Cartesian machine.
Bound lower_bound(const Contour& contour, const Machine& machine, double corner_angle, Progress progress);

/// Returns check "bound", s: `value` is the bound, `limit` the planned duration. A plan that is shorter than its bound
/// by more than 1e-9 of itself fails: one of the two is wrong.
Check bound_check(const Bound& bound, double planned);

}  // namespace bahnwerk
