#pragma once
/// Arc length as a function of the parameter, and its inverse.
///
/// Lines and arcs have closed forms. Rational pieces have adaptive panels; on each the speed is interpolated by a
/// polynomial of degree 11 at Chebyshev points and integrated exactly. A panel is bisected until the last two
/// coefficients are below 2e-13 of its mean speed (or negligible for the whole). Next to an end where the tangent
/// vanishes the panels shrink geometrically and the innermost one is the monomial s ~ ρ^(m+1), so that both directions
/// have full relative accuracy there. Accuracy of s(u), u(s): some 1e-15 of the length (tests hold 1e-12). Cost: below
/// 1 µs per panel; 4–25 panels for ordinary pieces. The inverse does not use Boost's
/// newton_raphson_iterate, which takes 1.2 times as long per point and measures its tolerance relative to the root,
/// which may be near 0 here.
#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry/curve/curve.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {

/// The arc length of one curve.
class ArcLength {
 public:
  /// The curve is read, not stored. Rational pieces have to be regular inside (core/geometry/path/regular.hpp).
  explicit ArcLength(const Curve& curve);

  double length() const { return length_; }
  /// Returns s(u) from the beginning, mm; u is clamped to the curve. O(log panels).
  double at(double u) const;
  /// Writes s(u) at all parameters of a batch to batch.s.
  void at(PathBatch& batch) const;
  /// Returns u(s); s is clamped to [0, length()]. O(log panels), usually one step, of third order, from a polynomial
  /// start.
  double inverse(double s) const;
  /// Returns two values at once, at little more than the cost of one where they lie in one panel, ascending.
  PointPair inverse(PointPair s) const;
  /// Returns the borders of the panels, ascending from the first to the last parameter.
  std::vector<double> borders() const;

 private:
  static constexpr std::size_t terms = 13;  ///< number of coefficients of s on a panel
  static constexpr std::size_t starts = 8;  ///< number of coefficients of the polynomial that starts Newton's method
  struct Panel {
    double centre, inverse_half;      ///< x = (u − centre)·inverse_half ∈ [−1, 1]
    double base;                      ///< s = base + Σ s[k] x^k
    double s_middle, s_inverse_half;  ///< y = (s − s_middle)·s_inverse_half ∈ [−1, 1]
    std::array<double, terms> s;
    std::array<double, starts> start;  ///< x ≈ Σ start[k] y^k
    unsigned monomial;                 ///< > 0: s = base + s[monomial] x^monomial alone
  };
  void add(const Rational& curve, double a, double b, int depth, double scale);
  void add_monomial(const Rational& curve, double a, double b, double end, std::size_t order);
  void finish(Panel panel, double a, double b);
  double inverse_on(const Panel& panel, double s) const;

  double begin_, end_, length_ = 0;
  std::vector<double> u_, s_;  ///< borders, panels + 1 of each; empty for constant speed
  std::vector<Panel> panels_;
};

}  // namespace bahnwerk
