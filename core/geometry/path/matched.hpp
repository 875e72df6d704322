#pragma once
/// Distances of two curves that are traversed forwards at once: nearest points, and proven bounds.
#include <cstddef>
#include <utility>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/second_derivative_bound.hpp"

namespace bahnwerk {

/// A point of a curve: its parameter, and its distance from another point, mm.
struct Nearest {
  double u = 0, distance = 0;
};

/// Returns the point of a curve between u0 and u1 nearest to p. It is certainly the nearest one only where the curve
/// turns little (by less than 0.5 rad, say); otherwise it is one of the local minima. At most 40 evaluations.
Nearest nearest(const Curve& curve, double u0, double u1, Vec p);

/// A pair of intervals, [a0, a1] of one curve and [b0, b1] of another, whose beginnings and whose ends are matched, at
/// the distances d0 and d1, mm.
struct MatchedPieces {
  double a0 = 0, a1 = 0, b0 = 0, b1 = 0, d0 = 0, d1 = 0;
  /// Returns the larger one of d0 and d1; NaN if d0 is.
  double ends() const { return d0 > d1 || d0 != d0 ? d0 : d1; }
};

/// Bounds the distance of matched pieces of two curves.
///
/// Traversed linearly in both parameters, the pieces are nowhere further apart than the farther pair of ends plus the
/// bulges of both from their chords, max|h_uu| Δu²/8 each (core/geometry/path/second_derivative_bound.hpp). Pieces are
/// halved, with the middle matched to the nearest place on the other curve, until this bound suffices.
class MatchedDistance {
 public:
  /// Reports to `progress`, if given: long curves take many halvings, 1 to 3 µs each.
  MatchedDistance(const Curve& a, const Curve& b, ProgressScope* progress = nullptr)
      : a_(a), b_(b), second_a_(a), second_b_(b), progress_(progress) {}

  /// Returns a bound of the distance along some matching of the pieces that is forward on both: at most max(found,
  /// largest distance evaluated) + slack; `found` is raised to the latter. Ends early with a bound above `tolerance` if
  /// a matched pair is farther apart than that. The result is NaN if a coordinate is.
  double bound(const MatchedPieces& pieces, double tolerance, double slack, double& found) const;

 private:
  double halve(const MatchedPieces& pieces, double tolerance, double slack, double& found, int depth) const;

  const Curve &a_, &b_;
  SecondDerivativeBound second_a_, second_b_;
  ProgressScope* progress_;
};

}  // namespace bahnwerk
