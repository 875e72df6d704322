#pragma once
/// A pose path as one clamped NURBS, and as the pieces that it consists of [Herrmann (4.62), (4.63)].
#include <span>
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"

namespace bahnwerk {

/// The domain is [knots[degree], knots[points.size()]]; there are points + degree + 1 knots, the end ones degree + 1
/// times.
struct NurbsPath {
  std::size_t degree = 1;
  std::vector<HomogeneousPoint> points;
  std::vector<double> knots;

  double begin() const { return knots[degree]; }
  double end() const { return knots[points.size()]; }
  /// Evaluates by de Boor's scheme on control points of the derivatives; at a knot the span to its right counts, at the
  /// end the last one. O(degree²), no allocation.
  SplineJet at(double u) const;
  /// Returns one piece per knot span, each over its own v ∈ [0, 1], by knot insertion [Piegl, Tiller: The NURBS Book,
  /// 5.3].
  std::vector<BezierPiece> pieces() const;
};

/// Joins pieces to one curve: they are raised to the highest degree, weights of each are scaled so that they continue
/// those of the piece before, and inner knots have the multiplicity of the degree. Piece n has u ∈ [n, n + 1] with an
/// unchanged parameter. The first control point of a piece is the end point of the one before: throws
/// std::invalid_argument where these are more than 1e-9 apart (mm, rad), and for no pieces.
NurbsPath united(std::span<const BezierPiece> pieces);

}  // namespace bahnwerk
