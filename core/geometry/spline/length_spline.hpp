#pragma once
/// Arc length of one piece by a cubic spline through the points of an adaptive Simpson rule [Herrmann (4.67)–(4.70)].
/// The exact alternative is ArcLength (core/geometry/path) of place_curve().
#include <cstddef>
#include <vector>

#include "core/geometry/curve/rational.hpp"
#include "core/geometry/spline/bezier_piece.hpp"

namespace bahnwerk {

/// Returns the first three coordinates as a curve of space over the piece's parameter.
Rational place_curve(const BezierPiece& piece);

/// The arc length σ(v) of the first three coordinates, mm, for v on [0, 1].
///
/// An interval is halved until (4.69) holds with its share of `tolerance`, so the tolerance ε applies to the whole
/// piece (in the source to each interval). The factor 1/10 of (4.69) has an asymptotic safety of 1.5. The spline
/// between the points has an error that ε does not limit: tests compare both with the exact length. Each piece has its
/// own spline, because σ′ jumps where pieces join geometrically: a C² spline over the whole path, as in the source,
/// oscillates there. Cost: 4 speeds per point; the number of points grows with ε^(−1/4).
class LengthSpline {
 public:
  /// Throws std::invalid_argument for a tolerance below 1e-12 mm.
  LengthSpline(const BezierPiece& piece, double tolerance);

  double length() const { return values_.back(); }
  /// Returns σ(v); v is clamped to [0, 1]. O(log points).
  double at(double v) const;
  /// Returns v(σ) by bisection and Newton's method; σ is clamped. O(log points).
  double inverse(double length) const;
  /// Returns the interpolated points and their lengths.
  const std::vector<double>& parameters() const { return parameters_; }
  const std::vector<double>& values() const { return values_; }

 private:
  std::vector<double> parameters_, values_, slopes_;  ///< the C² spline in Hermite form
};

}  // namespace bahnwerk
