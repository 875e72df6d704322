#pragma once
/// How far two curves are apart when both are traversed forward at once: nearest points, and proven bounds.
#include <cstddef>
#include <utility>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/bend_bound.hpp"

namespace bahnwerk {

struct Nearest {
  double u = 0, distance = 0;
};

/// The point of a curve between u0 and u1 nearest to p. The nearest one for certain only where the curve turns little
/// (by less than 0.5 rad, say); otherwise one of those where the distance is least locally. ≤ 40 evaluations.
Nearest nearest(const Curve& curve, double u0, double u1, Vec p);

/// [a0, a1] of one curve traversed together with [b0, b1] of another: their begins and their ends belong together, at
/// the distances d0 and d1, mm.
struct MatchedPieces {
  double a0 = 0, a1 = 0, b0 = 0, b1 = 0, d0 = 0, d1 = 0;
  double ends() const { return d0 > d1 || d0 != d0 ? d0 : d1; }
};

/// Bounds the distance of matched pieces of two curves.
///
/// Traversed linearly in both parameters they are nowhere further apart than the farther pair of ends plus what both
/// bulge from their chords, max|h_uu| Δu²/8 each (core/geometry/path/bend_bound.hpp). Pieces are halved, and the place
/// on the other curve that is nearest to the middle is matched to it, until that suffices.
class MatchedDistance {
 public:
  /// Long curves take many halvings, 1 to 3 µs each: `scope`, if any, is told.
  MatchedDistance(const Curve& a, const Curve& b, ProgressScope* scope = nullptr)
      : a_(a), b_(b), bend_a_(a), bend_b_(b), scope_(scope) {}

  /// A bound of the distance along some matching of the pieces that goes forward on both: at most max(found, largest
  /// distance evaluated) + slack; `found` is raised to the latter. Ends early with a bound above `tolerance` where a
  /// matched pair is farther apart than that. Not a number if a coordinate is.
  double bound(const MatchedPieces& pieces, double tolerance, double slack, double& found) const;

 private:
  double halve(const MatchedPieces& pieces, double tolerance, double slack, double& found, int depth) const;

  const Curve &a_, &b_;
  BendBound bend_a_, bend_b_;
  ProgressScope* scope_;
};

}  // namespace bahnwerk
