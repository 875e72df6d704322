#pragma once
/// A C∞ piece of a curve: a polynomial, or a quotient of polynomials N(u)/w(u) with w > 0, of degree ≤ 24.
///
/// It is stored in the power basis of t = (u − pivot)/reach with |t| ≤ 1, relative to an origin on the curve, so that
/// neither large coordinates nor a parameter far from 0 cost digits. Power-basis rounding grows like 2.4ⁿ ε at worst
/// (degree 5: 80 ε, degree 16: 1e6 ε), and with the ratio of the weights. Evaluation is Horner's scheme with
/// derivatives; its cost is measured by tests/bench/bench_curve.cpp.
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry/curve/curve.hpp"
#include "core/numeric/polynomial.hpp"

namespace bahnwerk {

/// Immutable; see Curve.
class Rational final : public Curve {
 public:
  static constexpr std::size_t max_degree = 24;

  /// Returns h(u) = Σ rows[d][k] u^k on [0, 1], one row per coordinate (2 or 3; rows may differ in length). Throws
  /// InvalidInput at {"polynomial","coefficients",…} for values that are not finite or beyond 1e9, empty rows, or a
  /// degree above 24.
  static Rational from_power_basis(const std::vector<std::vector<double>>& rows);
  /// Returns a Bézier curve on [0, 1]; no weights mean all one. Throws InvalidInput at {"points"…} or {"weights"…} for
  /// values that are not finite or beyond 1e9 mm, weights that are not positive or more than a factor of 1e6 apart,
  /// counts that do not match, and a degree outside 1 … 24.
  static Rational bezier(const std::vector<Vec>& points, const std::vector<double>& weights = {});

  CurveKind kind() const override { return CurveKind::rational; }
  double begin() const override { return begin_; }
  double end() const override { return end_; }
  Jet at(double u) const override;
  double speed(double u) const override;
  bool derivatives(PathBatch& batch) const override;

  std::size_t degree() const { return degree_; }
  bool rational() const { return rational_; }
  /// Returns the curve restricted to [u0, u1] and expanded about `pivot` ∈ [u0, u1]; the parameter is unchanged. The
  /// lowest coefficients 1 … `vanishing` are set to exactly 0, which makes the parametric tangent vanish to that order
  /// at the pivot, an end, with full relative accuracy around it.
  Rational restricted(double u0, double u1, double pivot, std::size_t vanishing = 0) const;
  /// Returns the image under p ↦ (rows · p) + offset with orthonormal rows. The parameter is unchanged.
  Rational mapped(const std::array<Vec, 3>& rows, Vec offset) const;
  /// Returns the order of the zero of dh/du at an end (0: none), as set by restricted(). The tangent vanishes at one
  /// end at most.
  std::size_t vanishing_begin() const { return pivot_ == begin_ ? vanishing_ : 0; }
  std::size_t vanishing_end() const { return pivot_ == end_ ? vanishing_ : 0; }

  /// Returns the coefficients for analysis: h(u) = origin + (N_x, N_y, N_z)(t)/w(t), t = (u − pivot)/reach; w = {1} for
  /// a polynomial.
  Vec origin() const { return origin_; }
  double pivot() const { return pivot_; }
  double reach() const { return reach_; }
  Polynomial coordinate(std::size_t axis) const;
  Polynomial weight() const;
  /// Returns Σ |coefficient| of the numerators without the constant, mm, which bounds the extent of the piece up to the
  /// weight.
  double extent() const { return extent_; }
  /// Returns the error of a coefficient that rounding of the input coordinates may cause, mm.
  double noise() const { return noise_; }
  /// Returns whether the whole piece lies on one straight line, to 1e-12 of its extent (or the rounding of the
  /// coordinates).
  bool collinear() const;
  /// Returns the projection of a collinear piece onto its line, so that rounding does not hide where it reverses.
  Rational straightened() const;

 private:
  Rational() = default;
  Vec longest() const;
  Vec numerator(std::size_t k) const {
    return {c_[k * stride_], c_[k * stride_ + 1], stride_ == 4 ? c_[k * 4 + 2] : 0.0};
  }
  /// Where a piece lies in its parameter: on [begin, end], expanded about `pivot`.
  struct Domain {
    double begin = 0, end = 1, pivot = 0.5;
    double reach() const { return std::max(end - pivot, pivot - begin); }
  };
  Domain domain() const { return {begin_, end_, pivot_}; }
  /// Returns origin + numerator/weight; `noise` is that of noise().
  static Rational build(const Polynomial (&numerator)[3], const Polynomial& weight, Vec origin, const Domain& domain,
                        double noise);

  double pivot_ = 0, inverse_ = 1, reach_ = 1, begin_ = 0, end_ = 1;
  Vec origin_;
  std::size_t degree_ = 0, stride_ = 2, vanishing_ = 0;
  bool rational_ = false, plane_ = true;
  std::vector<double> c_;  ///< coefficients of t^k begin at k·stride: x y [z w]; z = 0 and w = 1 if not stored
  std::vector<double> d_;  ///< coefficients of the derivative, for polynomials
  double extent_ = 0, noise_ = 0;
};

}  // namespace bahnwerk
