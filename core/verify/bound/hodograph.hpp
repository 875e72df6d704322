#pragma once
/// Enclosures of the direction and of the derivatives of a rational curve between two parameters.
#include <array>
#include <cstddef>

#include "core/geometry/curve/rational.hpp"

namespace bahnwerk::verify {

/// The tangent of a curve h = N/w has the direction of V = N' w − N w' (N' for a polynomial), whose components are
/// polynomials with the signs of those of h'. About the middle of the interval, V = Σ v_j x^j with |x| ≤ 1; all bounds
/// follow from the magnitudes of the v_j. Rounding of the v_j is included, from the magnitudes of their terms.
class Hodograph {
 public:
  /// Computes V. O(degree²).
  explicit Hodograph(const Rational& curve);

  /// Range of every component of h' by arc length over [u0, u1].
  struct Range {
    std::array<double, 3> low{-1, -1, -1}, high{1, 1, 1};
  };
  /// Computes the range. V lies in a cone about its value in the middle; in addition, a component whose linear term
  /// exceeds the others is monotone and has at most the sign change of its ends. Terms from the fifth power on are
  /// bounded together, over a sixteenth of the curve. O(degree): 50 ns for planar cubics.
  Range range(double u0, double u1);

  /// Upper bounds of |h''|, 1/mm, and |h'''|, 1/mm², by arc length; infinite where V cannot be shown not to vanish.
  struct DerivativeBounds {
    double second = 0, third = 0;
  };
  DerivativeBounds derivative_bounds(double u0, double u1) const;

 private:
  static constexpr std::size_t terms = 2 * Rational::max_degree;
  static constexpr std::size_t few = 5, parts = 16;
  using Row = std::array<double, terms>;
  static void expand(const Row& from, std::size_t count, double middle, double half, Row& to);
  static std::array<double, few> expand(const Row& from, std::size_t count, double middle, double half);
  std::array<double, 3> rest(double t0, double t1);

  double pivot_, inverse_reach_;
  std::size_t axes_ = 2, count_ = 0, weights_ = 1;  ///< numbers of components of V, and of coefficients of V and of w
  std::array<Row, 3> v_{};                          ///< coefficients of V
  Row size_{};  ///< magnitudes of the coefficients of all components together without cancellation
  Row w_{};
  double begin_, width_;                              ///< interval of t
  std::array<std::array<double, 3>, parts> fifth_{};  ///< bounds of V⁽⁵⁾/5! over parts of the curve, computed on demand
  std::array<bool, parts> known_{};
};

}  // namespace bahnwerk::verify
