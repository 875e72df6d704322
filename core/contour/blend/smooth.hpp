#pragma once
/// The smoothest quintic spline through a tube of balls: it minimises ∫ w |f'''|² dt subject to |f(tᵢ) − pᵢ| < rᵢ.
///
/// The method is the primal–dual interior-point method of numeric/interior_point/feasible.hpp with the slacks rᵢ² −
/// |f(tᵢ) − pᵢ|². It starts from a smoothing spline inside the tube (a quadratic penalty instead of the logarithm) and
/// from the multipliers of that penalty. The weights make the energy dimensionless and uniform: w = H⁵/ρ² per break
/// interval, with H the length on which the tube lets a curve bend (its "scale") and ρ the tube's radius, so that rough
/// and smooth regions of one contour have equal weight. All systems are banded: O(breaks + sites) per step, some 20
/// steps, 0.3 µs each per interval in the plane.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/curve/curve.hpp"

namespace bahnwerk::blending {

/// A site of the tube: |f(t) − p| < radius.
struct TubeSite {
  double t = 0;       ///< parameter, mm along the contour
  Vec p;              ///< point of the contour, mm
  double radius = 0;  ///< mm
};

/// Condition at one end of the spline.
struct TubeEnd {
  bool clamped = false;  ///< whether three derivatives by t are given; otherwise only the position
  Jet jet;
};

/// The tube, the breaks of the spline, and the conditions at its ends.
struct TubeProblem {
  std::size_t dimension = 2;    ///< 2 or 3 coordinates
  std::vector<TubeSite> sites;  ///< ascending t, strictly inside the breaks
  std::vector<double> breaks;   ///< strictly ascending, at least 8 intervals
  std::vector<double> scale;    ///< H per interval, mm
  TubeEnd begin, end;
};

/// The result: a spline with its knots and control points.
struct TubeSpline {
  std::vector<double> knots;
  std::vector<Vec> points;  ///< degree 5
  bool inside = false;      ///< whether |f(tᵢ) − pᵢ| < rᵢ at every site
  std::size_t worst = 0;    ///< site with the largest violation, if not inside
  std::size_t steps = 0;    ///< Newton steps taken

  /// Returns f and its derivatives in break interval `span`.
  Jet at(std::size_t span, double t) const;
};

/// Returns the spline; `inside` is false if no spline with these breaks fits the tube. Reports to `progress` at least
/// every 20 ms and passes its exceptions on.
TubeSpline smooth_in_tube(const TubeProblem& problem, ProgressScope& progress);

}  // namespace bahnwerk::blending
