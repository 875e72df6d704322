#pragma once
/// Bounds of a curve's derivatives by arc length on discs in the complex plane. Interpolation errors of functions of
/// these derivatives follow from such bounds, independently of the samples [Trefethen, Approximation Theory and
/// Approximation Practice, 2013, theorem 8.2].
#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry/curve/curve.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/numeric/polynomial.hpp"

namespace bahnwerk::verify {

/// A disc |u − centre| < radius of complex parameters in which h′, h″, h‴ (by arc length) and s are analytic. The
/// members are upper bounds of their magnitudes (norms of complex vectors, mm). radius = 0 means that nothing is known.
struct CurveDisc {
  double centre = 0, radius = 0;
  double first = 0, second = 0, third = 0;  ///< bounds of |h′|, |h″|, |h‴|
  double speed = 0, pace = 0;               ///< bounds of |ds/du|, |du/ds|
};

/// Discs of one curve, computed on demand. With V = w² h_u, X = V′ × V, ν² = V·V, from u = pivot + reach·t:
///
///   h′ = V/ν,   h″ = w² (V × X)/ν⁴,   h‴ = (w²/ν) d/dt h″,   ds/dt = ν/w².
///
/// All are analytic where ν² ≠ 0 ≠ w. V, w, ν² and X are polynomials; the magnitudes of their Taylor coefficients about
/// a centre bound them on a disc, which is as large as |ν² − ν²(c)| ≤ 0.6 ν²(c) and |w − w(c)| ≤ 0.3 w(c) allow. The
/// effect of rounding of the coefficients is added (32 degree·ε of the terms' magnitudes). Arcs: |cos(φ + iy)|² +
/// |sin(φ + iy)|² = cosh 2y, for |y| ≤ 2.5.
class CurveDiscs {
 public:
  static constexpr double largest = 4;  ///< radius where |t| ≤ 1 on the curve
  /// The curve is read, not stored. `start` is the first radius in t that is tried for a rational piece.
  explicit CurveDiscs(const Curve& curve, double start = largest);
  /// Returns a suitable start for a similar curve.
  double start() const { return start_; }
  /// Returns a disc about `u`, at least half as large as the largest one there. O(degree²) for a new one, a few ns
  /// where the previous disc is large enough, as for most queries in ascending order.
  CurveDisc about(double u);

  /// Returns the order m of the zero of h_u at an end of the curve; 0: none.
  std::size_t vanishing() const { return vanishing_; }
  double vanishing_at() const { return pivot_; }
  /// Returns the disc about that end, where h″ and h‴ may have poles: V = z^m W, and the bounds hold on the circle |u −
  /// centre| = radius (those of `speed` in all of the disc). A function that is analytic inside has no larger values in
  /// the disc.
  const CurveDisc& at_vanishing_tangent();

 private:
  CurveDisc make(double centre, std::size_t vanishing = 0);

  CurveDisc last_, end_disc_;
  double start_;
  bool end_known_ = false;
  std::size_t vanishing_ = 0;
  bool rational_ = false;
  double pivot_ = 0, reach_ = 1, begin_ = 0, end_ = 1;
  Polynomial v_[3], w_, v_terms_, w_terms_;  ///< *_terms_: sums of the magnitudes that enter a coefficient
  std::vector<Vec> v_at_, x_at_;             ///< Taylor coefficients about a centre
  std::vector<double> v_sizes_, x_sizes_;    ///< norms of these coefficients
  Polynomial w_at_, q_at_;
};

/// Computes the discs of every axis of a machine whose tool, which does not turn, follows the path through the disc's
/// centre, by the chain rule: |q′| ≤ m₁|h′|, |q″| ≤ m₂|h′|² + m₁|h″|, |q‴| ≤ m₃|h′|³ + 3m₂|h′ h″| + m₁|h‴|, with the
/// map's bounds m for the range of the tool's position h on the disc. The disc is halved until bounds are known;
/// returns false if none are found.
bool through(const KinematicAxisPath& path, std::size_t segment, const CurveDisc& tool,
             std::array<CurveDisc, max_axes>& axes);

/// Discs of every axis along a path: the path's own enclosures (AxisPath::enclose), else through().
class AxisDiscsAlong {
 public:
  explicit AxisDiscsAlong(const KinematicAxisPath& path) : path_(path) {}
  /// Returns the discs about the centre of the tool's disc, as large as intervals of half width `half` (of the
  /// parameter) need, or null if unknown. The result is valid until the next call. For queries in order one
  /// enclosure is used many times.
  const std::array<CurveDisc, max_axes>* about(std::size_t segment, const CurveDisc& tool, double half);

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  bool enclose(std::size_t segment, const CurveDisc& tool, double radius);

  const KinematicAxisPath& path_;
  std::size_t segment_ = none;  ///< segment to which made_ belongs
  std::array<CurveDisc, max_axes> made_, moved_;
};

}  // namespace bahnwerk::verify
