#pragma once
/// Derivatives by arc length next to a vanishing parametric tangent, where the usual quotients are 0/0.
#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {

/// The curve is h = N/w, and ρ ≥ 0 is the scaled distance from the end. The zeros of V = w² h' = ρᵐ W(ρ) and of
/// W × W' = ρʳ C(ρ) are divided out as polynomials, so the tangent W/|W|, the binormal curvature b = w² ρ^(r−m) C/|W|³
/// and db/ds are free of cancellation for every ρ > 0, and have limits at 0. Valid in the near zone ρ ≤ 1/16.
/// O(degree), no allocation after construction.
class EndExpansion {
 public:
  /// `curve` has a vanishing tangent at exactly one end.
  explicit EndExpansion(const Rational& curve);

  /// Returns whether u lies in the near zone.
  bool covers(double u) const { return (u - end_) * inward_ <= zone_; }
  /// Writes d1, d2, d3 of `point` by arc length at u; at the end itself the one-sided limits, or 0 for a derivative
  /// without one.
  void derivatives(double u, Jet& point) const;
  /// Returns whether the curvature grows without bound towards the end.
  bool unbounded() const { return curvature_power_ < 0; }

 private:
  using Rows = std::vector<Vec>;
  double end_, inward_, inverse_reach_, zone_;
  int curvature_power_, rate_power_;
  Rows tangent_, binormal_, rate_;  ///< W, C, and the numerator of db/ds
  std::vector<double> weight_;
};

}  // namespace bahnwerk
