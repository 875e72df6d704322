#pragma once
/// The smoothest quintic spline through a tube of balls: it minimises ∫ w |f'''|² dt subject to |f(tᵢ) − pᵢ| < rᵢ.
///
/// Primal-dual interior-point method for ½∫w|f'''|² − μ Σ gᵢ log(1 − |f(tᵢ) − pᵢ|²/rᵢ²) with falling μ, started from a
/// smoothing spline (a quadratic penalty instead of the logarithm) that lies inside the tube, and from the multipliers
/// that this penalty stands for. A step of Newton's method for the logarithm itself goes no further than the one site
/// lets it that is next to its wall: 33 steps for 1 000 intervals of a rough surface, 18 of these. The weights make the
/// energy dimensionless and even: w = H⁵/ρ² per break interval, where H is the length on which the tube lets a curve
/// bend (its "scale") and ρ the tube's radius; so rough and calm regions of one contour count alike. All systems are
/// banded: O(breaks + sites) per step, some 20 steps, 0.3 µs each per interval in the plane.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/curve/curve.hpp"

namespace bahnwerk::blending {

struct TubeSite {
  double t = 0;
  Vec p;
  double radius = 0;  ///< mm
};

struct TubeEnd {
  bool clamped = false;  ///< three derivatives are given, by t; otherwise only the position
  Jet jet;
};

struct TubeProblem {
  std::size_t dimension = 2;
  std::vector<TubeSite> sites;  ///< ascending t, strictly inside the breaks
  std::vector<double> breaks;   ///< strictly ascending, at least 8 intervals
  std::vector<double> scale;    ///< H per interval, mm
  TubeEnd begin, end;
};

struct TubeSpline {
  std::vector<double> knots;
  std::vector<Vec> points;  ///< degree 5
  bool inside = false;      ///< every site holds
  std::size_t worst = 0;    ///< if not: the site that is violated most
  std::size_t steps = 0;    ///< Newton steps taken

  /// f and its derivatives in break interval `span`.
  Jet at(std::size_t span, double t) const;
};

/// `scope` is told at least every 20 ms or so and may throw.
TubeSpline smooth_in_tube(const TubeProblem& problem, ProgressScope& scope);

}  // namespace bahnwerk::blending
