#pragma once
/// How far two curves are apart when both are traversed forward at once: nearest points, and proven bounds.
#include <cstddef>
#include <functional>
#include <utility>

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
  /// Long curves take many halvings, 1 to 3 µs each: `work`, if any, is told now and then how many there were since it
  /// was called last, at least every 250. It may throw.
  MatchedDistance(const Curve& a, const Curve& b, std::function<void(std::size_t)> work = {})
      : a_(a), b_(b), bend_a_(a), bend_b_(b), work_(std::move(work)) {}

  /// A bound of the distance along some matching of the pieces that goes forward on both: at most max(found, largest
  /// distance evaluated) + slack; `found` is raised to the latter. Ends early with a bound above `tolerance` where a
  /// matched pair is farther apart than that. Not a number if a coordinate is.
  double bound(const MatchedPieces& pieces, double tolerance, double slack, double& found) const;

 private:
  double halve(const MatchedPieces& pieces, double tolerance, double slack, double& found, int depth) const;

  const Curve &a_, &b_;
  BendBound bend_a_, bend_b_;
  std::function<void(std::size_t)> work_;
  mutable std::size_t halvings_ = 0;
};

}  // namespace bahnwerk
