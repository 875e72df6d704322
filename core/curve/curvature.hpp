#pragma once
/// Curvature of a path point (derivatives by arc length).
#include "core/curve/curve.hpp"

namespace bahnwerk {

/// κ = |h''|, 1/mm.
inline double curvature(const Jet& point) { return norm(point.d2); }
/// dκ/ds = h''·h'''/κ, 1/mm²; 0 where the curvature vanishes (a minimum of κ).
inline double curvature_rate(const Jet& point) {
  const double k = norm(point.d2);
  return k > 0 ? dot(point.d2, point.d3) / k : 0.0;
}

/// Derivatives by arc length from those by a parameter whose speed σ = |h_u| > 0. With ⊥ the part across the tangent T:
/// h_ss = h_uu⊥/σ²,  h_sss = (h_uuu⊥ − 3 (T·h_uu/σ) h_uu⊥)/σ³ − |h_ss|² T  (differentiate h_ss = κN once more; T·h_ss =
/// 0).
inline Jet by_arc_length(const Jet& h) {
  const double inverse = 1 / norm(h.d1), square = inverse * inverse;
  const Vec tangent = inverse * h.d1;
  const double along = dot(h.d2, tangent);
  const Vec across = h.d2 - along * tangent, third = h.d3 - dot(h.d3, tangent) * tangent;
  const Vec d2 = square * across;
  return {h.value, tangent, d2, (square * inverse) * (third - (3 * along * inverse) * across) - dot(d2, d2) * tangent};
}

}  // namespace bahnwerk
