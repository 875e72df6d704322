#pragma once
/// A rational Bézier piece of a pose path: up to five coordinates over v ∈ [0, 1], three of a position (mm) and two
/// angles (rad), after [Herrmann 4.3]. Unused coordinates are 0.
#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

constexpr std::size_t spline_dimension = 5;
constexpr std::size_t spline_orders = 5;  ///< the value and four derivatives: enough for G⁴

using SplinePoint = std::array<double, spline_dimension>;
/// Homogeneous coordinates [Herrmann (3.79)]: w·p, then w.
using HomogeneousPoint = std::array<double, spline_dimension + 1>;
/// Value and derivatives 1 … 4 by the piece's parameter.
using SplineJet = std::array<SplinePoint, spline_orders>;
using HomogeneousJet = std::array<HomogeneousPoint, spline_orders>;

inline Vec place(const SplinePoint& p) { return {p[0], p[1], p[2]}; }
HomogeneousPoint homogeneous(const SplinePoint& p, double weight);
SplinePoint projected(const HomogeneousPoint& p);
/// Returns the derivatives of the quotient from those of numerator and weight.
SplineJet projected(const HomogeneousJet& jet);

/// A rational Bézier curve by its homogeneous control points.
class BezierPiece {
 public:
  static constexpr std::size_t max_degree = 9;  ///< 2k + 1 for k = 4

  /// Degree = points − 1, 1 … 9; weights positive. Throws std::invalid_argument otherwise.
  explicit BezierPiece(std::vector<HomogeneousPoint> points);
  /// Returns the straight line of degree 1 with weights 1 [Herrmann (4.31)–(4.34)]; all five coordinates are linear.
  static BezierPiece line(const SplinePoint& from, const SplinePoint& to);

  std::size_t degree() const { return points_.size() - 1; }
  const std::vector<HomogeneousPoint>& points() const { return points_; }

  /// Evaluates by de Casteljau's algorithm: O(degree²), no allocation.
  HomogeneousJet homogeneous_at(double v) const;
  SplineJet at(double v) const { return projected(homogeneous_at(v)); }

  /// Returns the curve, with its parameter, as a piece of a higher degree [Piegl, Tiller: The NURBS Book, 5.5].
  BezierPiece elevated(std::size_t degree) const;
  /// Returns the curve with all weights multiplied by `factor` > 0.
  BezierPiece scaled(double factor) const;

 private:
  std::vector<HomogeneousPoint> points_;
};

}  // namespace bahnwerk
