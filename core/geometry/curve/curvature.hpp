#pragma once
/// Curvature of a path point (derivatives by arc length).
#include "core/geometry/curve/curve.hpp"

namespace bahnwerk {

/// Returns κ = |h''|, 1/mm.
inline double curvature(const Jet& point) { return norm(point.d2); }
/// Returns dκ/ds = h''·h'''/κ, 1/mm²; 0 where the curvature vanishes (a minimum of κ).
inline double curvature_rate(const Jet& point) {
  const double k = norm(point.d2);
  return k > 0 ? dot(point.d2, point.d3) / k : 0.0;
}

/// Converts derivatives by a parameter with the speed σ = |h_u| > 0 to derivatives by arc length. With ⊥ the part
/// perpendicular to the tangent T: h_ss = h_uu⊥/σ²,  h_sss = (h_uuu⊥ − 3 (T·h_uu/σ) h_uu⊥)/σ³ − |h_ss|² T (from
/// differentiating h_ss = κN; T·h_ss = 0).
inline Jet by_arc_length(const Jet& h) {
  const double inverse = 1 / norm(h.d1), square = inverse * inverse;
  const Vec tangent = inverse * h.d1;
  const double along = dot(h.d2, tangent);
  const Vec across = h.d2 - along * tangent, third = h.d3 - dot(h.d3, tangent) * tangent;
  const Vec d2 = square * across;
  return {h.value, tangent, d2, (square * inverse) * (third - (3 * along * inverse) * across) - dot(d2, d2) * tangent};
}

namespace curvature_detail {
inline PointPair root(PointPair x) {
  const PointPair r = {std::sqrt(x[0]), std::sqrt(x[1])};
  return r;
}
template <std::size_t axes>
inline void by_arc_length(PathBatch& batch) {
  const auto dot = [](const PointPair* a, const PointPair* b) {
    PointPair sum = a[0] * b[0] + a[1] * b[1];
    if constexpr (axes == 3) sum += a[2] * b[2];
    return sum;
  };
  for (std::size_t p = 0; p < batch.used_pairs(); ++p) {
    PointPair d1[axes], d2[axes], d3[axes];
    for (std::size_t k = 0; k < axes; ++k) {
      d1[k] = batch.d1[k].pair[p];
      d2[k] = batch.d2[k].pair[p];
      d3[k] = batch.d3[k].pair[p];
    }
    const PointPair inverse = 1 / root(dot(d1, d1)), square = inverse * inverse, cube = square * inverse;
    for (PointPair& x : d1) x *= inverse;
    const PointPair along = dot(d2, d1), third = dot(d3, d1), push = 3 * along * inverse;
    for (std::size_t k = 0; k < axes; ++k) d2[k] -= along * d1[k];
    for (std::size_t k = 0; k < axes; ++k) d3[k] = cube * (d3[k] - third * d1[k] - push * d2[k]);
    for (PointPair& x : d2) x *= square;
    const PointPair bent = dot(d2, d2);
    for (std::size_t k = 0; k < axes; ++k) {
      batch.d1[k].pair[p] = d1[k];
      batch.d2[k].pair[p] = d2[k];
      batch.d3[k].pair[p] = d3[k] - bent * d1[k];
    }
  }
}
}  // namespace curvature_detail

/// Converts a whole batch in place.
inline void by_arc_length(PathBatch& batch) {
  batch.planar ? curvature_detail::by_arc_length<2>(batch) : curvature_detail::by_arc_length<3>(batch);
}

}  // namespace bahnwerk
