#pragma once
/// A pose path as one clamped NURBS, and as the pieces that it consists of [Herrmann (4.62), (4.63)].
#include <span>
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"

namespace bahnwerk {

/// Over [knots[degree], knots[points.size()]]; as many knots as points + degree + 1, the end ones degree + 1 times.
struct NurbsPath {
  std::size_t degree = 1;
  std::vector<HomogeneousPoint> points;
  std::vector<double> knots;

  double begin() const { return knots[degree]; }
  double end() const { return knots[points.size()]; }
  /// By the scheme of de Boor on control points of the derivatives; at a knot the span to its right counts, at the end
  /// the last one. O(degree²), no allocation.
  SplineJet at(double u) const;
  /// One piece per knot span, each over its own v ∈ [0, 1], by inserting knots [Piegl, Tiller: The NURBS Book, 5.3].
  std::vector<BezierPiece> pieces() const;
};

/// Pieces end to end as one curve: raised to the highest degree, weights of each scaled so that they continue those of
/// the piece before, inner knots as often as the degree. Piece n takes u ∈ [n, n + 1] and keeps its parameter there.
/// Where a piece begins its control point is the end point of the one before: throws std::invalid_argument where these
/// are more than 1e-9 apart (mm, rad), and for no pieces.
NurbsPath united(std::span<const BezierPiece> pieces);

}  // namespace bahnwerk
