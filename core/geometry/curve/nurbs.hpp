#pragma once
/// Non-uniform rational B-splines: checked input, independent evaluation, and the C∞ pieces that a path is made of.
#include <cstddef>
#include <utility>
#include <vector>

#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {

/// A curve over the domain [knots[p], knots[n]], p = degree, n = number of points. Clamped ends are not required.
class Nurbs {
 public:
  static constexpr std::size_t max_degree = 16;

  /// Empty weights mean all one. Throws InvalidInput with all faults found, at {"nurbs","degree"},
  /// {"nurbs","points",i}, {"nurbs","weights",i}, {"nurbs","knots",i}. Required are degree 1 … 16; more points than the
  /// degree; coordinates within 1e9 mm; positive weights at most a factor of 1e6 apart; as many knots as points +
  /// degree + 1, finite, non-decreasing, none more than degree + 1 times (inside the domain degree times, since the
  /// curve would be discontinuous there, unless the points agree to 1e-9 mm); a non-empty domain.
  Nurbs(std::size_t degree, std::vector<Vec> points, std::vector<double> weights, std::vector<double> knots);

  std::size_t degree() const { return degree_; }
  const std::vector<Vec>& points() const { return points_; }
  const std::vector<double>& weights() const { return weights_; }  ///< one per point
  const std::vector<double>& knots() const { return knots_; }
  double begin() const { return knots_[degree_]; }
  double end() const { return knots_[points_.size()]; }

  /// Returns value and derivatives to order 3 by basis functions on homogeneous coordinates [Piegl, Tiller: The NURBS
  /// Book, A2.3, A4.2]; at a knot those of the span to its right, at the end those of the last span. O(degree²), no
  /// allocation.
  Jet at(double u) const;

  /// Returns the non-empty knot spans [u_k, u_{k+1}], ascending.
  std::vector<std::pair<double, double>> spans() const;
  /// Returns the Bézier pieces by blossoms: one piece per span of spans(), each over its own parameter (u −
  /// u_k)/(u_{k+1} − u_k) ∈ [0, 1]; spans on which all control points coincide are pieces without length. O(spans ·
  /// degree⁴).
  std::vector<Rational> pieces() const;

 private:
  std::size_t span(double u) const;

  std::size_t degree_;
  std::vector<Vec> points_;
  std::vector<double> weights_, knots_;
};

}  // namespace bahnwerk
