#pragma once
/// The problem of kind `probe_path` [Thielemann]: a measuring head passes given points, stays within `tolerance` of the
/// edges between them, is never faster than `speed`, and keeps the limits of acceleration, jerk and snap of every axis,
/// from rest to rest.
///
/// A motion x(t) on [0, T] is right when x is three times continuously differentiable with bounded snap; v = a = j = 0
/// at both ends, which are the first and the last point; there are times 0 = t_0 ≤ … ≤ t_N = T with
/// |x(t_i) − P_i| ≤ `point_tolerance`; on [t_i, t_(i+1)] the distance from the segment P_i P_(i+1) is ≤ `tolerance`
/// (a capsule, edge by edge in order); |v| ≤ `speed`; |a_k|, |j_k|, |s_k| of every axis keep their limits.
#include <cstddef>
#include <vector>

#include "core/geometry/curve/vec.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

enum class ProbeObjective { time, ripple };

struct ProbeProblem {
  std::vector<Vec> given;             ///< points of the document, mm; z = 0 in the plane
  std::vector<Vec> points;            ///< N + 1 ≥ 2 points, neighbours are different; ends are those of `given`
  std::vector<std::size_t> point_of;  ///< index in `points` of each given point; ascending
  double tolerance = 0;               ///< δ, mm: the radius of the tube, 0 or more
  double speed = 0;                   ///< mm/s, Euclidean
  double point_tolerance = 1e-6;      ///< mm
  /// Axes x, y (and z) with acceleration, jerk and snap, all positive and finite, velocity unlimited; the cycle time.
  Machine machine;
  ProbeObjective objective = ProbeObjective::time;
  double stretch = 1.25;  ///< objective `ripple`: longest duration relative to the shortest one, ≥ 1

  std::size_t dimension() const { return machine.axes.size(); }  ///< 2 or 3
  std::size_t edges() const { return points.size() - 1; }
  const AxisLimits& axis(std::size_t k) const { return machine.axes[k]; }
};

/// Sets `points` and `point_of` from `given` and `point_tolerance`. Consecutive points closer than a quarter of the
/// tolerance become one point, at the place of the first of them; the group of the very last point is at the place of
/// that point. A group holds only points within that distance of its place: a row of dense points does not shrink to
/// one, and a motion that passes noisy points within the tolerance one by one can pass a group at one time.
/// Throws InvalidInput at "points" if fewer than two points are left. O(points).
void merge_points(ProbeProblem& problem);

/// Returns the distance of a point from the segment from a to b, mm; a = b is a point. Accurate to a few roundings of
/// coordinates relative to a.
double distance_from_edge(Vec point, Vec a, Vec b);

/// Returns a bound on the rounding error of a distance between the problem's points, mm: 16 ε of the largest
/// coordinate.
double coordinate_rounding(const ProbeProblem& problem);

}  // namespace bahnwerk
