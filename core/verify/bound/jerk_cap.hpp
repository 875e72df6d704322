#pragma once
/// The largest b = v² that limits of jerk leave on a short piece of the path.
///
/// Over a piece that takes the time T the acceleration of axis k, q″_k b + q′_k v̇, changes by at most J_k T. The sum
/// of two axes' accelerations weighted by q′_m and −q′_k of the middle hardly contains v̇; the rest is P b with P = Σ
/// weight · q″, and P is known at both ends. A fast motion takes little time, and b cannot change much: where P does,
/// the motion is too fast. This limits the speed where curvature sets in, where the convex problem in v² would let time
/// pass instead.
///
/// Bounds of the change of b: q′_k² b changes by at most 2 Y_k |Δq_k|, with Y_k the largest acceleration of an axis;
/// where q′ is a unit vector b changes by at most 2 Σ |q′_k| Y_k per length. Y_k ≤ A_k, and an axis that keeps its
/// direction for a distance D cannot brake arbitrarily. With u its speed, y its deceleration and jerk ≤ J, y² − 2 J u
/// does not fall while it brakes; so it would come to rest, still braking, and turn round, within u²/(2 √(y² − 2 J u)).
/// Hence
///   y ≤ √(2 J u) + u²/(2 D).
/// At the end of that distance, at a place that it reaches in an unchanged direction, its acceleration is at most some
/// y_end: if it brakes throughout, y² − 2 J u is at most y_end² there, otherwise y² ≤ 2 J u, so
///   y ≤ √(2 J u + y_end²).
/// Joints at which its acceleration may step add the sum s of these steps: y less the steps to come grows likewise. All
/// of this holds backwards in time for an axis that speeds up.
///
/// A motion that exceeds some b anywhere in the piece can be slowed down to reach just that, and keeps all limits. So
/// if b is impossible, larger values are, too.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace bahnwerk::verify {

/// Distance that an axis travels in an unchanged direction, mm, the sum of the steps of its acceleration on that
/// distance, and its largest acceleration at the end of it, mm/s². Without a value nothing is known.
struct AxisWay {
  double displacement = 0, steps = 0, end = std::numeric_limits<double>::infinity();
};

/// Returns the largest acceleration of an axis at speed u against (ahead) or in (behind) its direction, mm/s².
inline double most_braking(double u, double jerk, const AxisWay& w) {
  const double free = 2 * jerk * u;
  return w.steps + std::min(std::sqrt(free) + u * u / (2 * w.displacement), std::sqrt(free + w.end * w.end));
}

template <int N>
struct JerkCapPiece {
  using Row = std::array<double, N>;
  std::size_t axes = N;
  Row acceleration{}, jerk{};  ///< limits of the axes; jerk may be infinite
  std::array<AxisWay, N> ahead{},
      behind{};                        ///< ways of the axes from the end onwards, and from the beginning backwards
  double length = 0;                   ///< mm
  std::array<Row, 2> tangent{}, q2{};  ///< q′, q″ at both ends
  Row least{}, most{};        ///< bounds of |q′_k| over the whole piece; least is 0 where the axis may reverse
  Row displacement{};         ///< upper bound of |Δq_k|
  double rounding_error = 0;  ///< effect of rounding on a component of q′
  bool unit = false;          ///< |q′| = 1, and q″ ⟂ q′
};

struct JerkCap {
  double cap = 0;     ///< mm²/s²
  double change = 0;  ///< bound of the change of b along the piece at that cap
};

/// Whether jerk may leave less than `most`, by the ends alone. 20 ns for two axes.
template <int N>
bool jerk_may_limit(const JerkCapPiece<N>& piece, double most);

/// Returns the cap, at most `most`, which is finite: an upper bound, to 2e-3 where `most` is a thousand times larger.
/// 0.05 µs for two axes where `most` is possible, 0.5 µs where not.
template <int N>
JerkCap jerk_cap(const JerkCapPiece<N>& piece, double most);

extern template bool jerk_may_limit<2>(const JerkCapPiece<2>&, double);
extern template JerkCap jerk_cap<2>(const JerkCapPiece<2>&, double);
extern template bool jerk_may_limit<3>(const JerkCapPiece<3>&, double);
extern template JerkCap jerk_cap<3>(const JerkCapPiece<3>&, double);
extern template bool jerk_may_limit<5>(const JerkCapPiece<5>&, double);
extern template bool jerk_may_limit<8>(const JerkCapPiece<8>&, double);
extern template JerkCap jerk_cap<5>(const JerkCapPiece<5>&, double);
extern template JerkCap jerk_cap<8>(const JerkCapPiece<8>&, double);

}  // namespace bahnwerk::verify
