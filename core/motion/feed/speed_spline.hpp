#pragma once
/// The feed as a cubic B-spline along the path [Herrmann 4.4.3, (4.78)], and the motion that it defines.
///
/// The source's spline has the path's parameter u. With v = 0 at the start and dv/dσ finite, ∫dσ/v diverges and the tip
/// never starts. Here its parameter is w with σ(w) = w + const except in the first and the last spans, where σ = h
/// φ(x), φ = x⁴ − 0.6 x⁵, x the distance from the end over the width h of these spans together: φ(1) = 0.4, φ′(1) = 1,
/// φ″(1) = 0. With three control points 0 at each end, v ~ w³ ~ σ^(3/4): the law of constant snap, at rest with v = a =
/// j = 0 (4.79).
///
/// With g = dv/dσ = v_w/σ_w:   a = v g,   j = v (g² + v dg/dσ),   dg/dσ = (v_ww σ_w − v_w σ_ww)/σ_w³.
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace bahnwerk {

/// The knots of the spline. Control points are given with each call.
class SpeedSpline {
 public:
  static constexpr std::size_t order = 4;  ///< number of control points that influence a span
  static constexpr std::size_t fixed = 3;  ///< number of control points that are 0 at each end

  /// `breaks` are places along the path, mm, ascending, the path's ends included; a span lies between any two
  /// neighbours. The first and the last `graded` ≥ 1 spans, which may be all, have equal widths in w instead.
  SpeedSpline(std::vector<double> breaks, std::size_t graded);

  std::size_t spans() const { return breaks_.size() - 1; }
  std::size_t points() const { return spans() + order - 1; }

  /// A place: σ with its derivatives by w, and for each control point of the span (from number `span` on) its share of
  /// v, v_w, v_ww.
  struct Place {
    std::size_t span = 0;
    double s = 0, s1 = 0, s2 = 0;
    std::array<double, order> b0{}, b1{}, b2{};
  };
  /// Returns the place at x ∈ [0, 1] of a span's width in w.
  Place at(std::size_t span, double x) const;
  double width(std::size_t span) const {
    return knot(span + order) - knot(span + order - 1);
  }  ///< width of a span in the parameter w

  struct State {
    double v = 0, a = 0, j = 0;
    std::array<double, order> dv{}, da{}, dj{};  ///< gradients by the span's control points
  };
  /// Returns the state at a place other than the very ends of the path, where all is 0 and g is undefined.
  static State state(const Place& place, std::span<const double> control);

 private:
  double knot(std::size_t i) const { return knots_[i]; }

  std::vector<double> breaks_, knots_;
  std::size_t graded_;
  double first_width_, last_width_;  ///< widths in w of the graded spans together
};

}  // namespace bahnwerk
