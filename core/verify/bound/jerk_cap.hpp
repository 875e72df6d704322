#pragma once
/// An upper bound of b = v² on a short piece of the path, from limits of jerk.
///
/// The idea. Over a piece that takes the time T, the acceleration of axis k, q″_k b + q′_k v̇, changes by at most J_k T.
/// Take two axes m and k, and the sum of their accelerations with the weights q′_m and −q′_k of the middle of the
/// piece. v̇ nearly cancels in this sum; P b remains, with P = Σ weight · q″, which is known at both ends. A fast motion
/// takes little time, in which b cannot change much. If P changes more than J_k T allows, the motion is too fast. This
/// limits the speed where curvature begins, which the convex problem in v² does not: it can let time pass there.
///
/// Bounds of the change of b. With Y_k the largest acceleration of axis k on the piece, q′_k² b changes by at most
/// 2 Y_k |Δq_k|; where q′ is a unit vector, b changes by at most 2 Σ |q′_k| Y_k per length. Y_k is at most A_k. It is
/// less for an axis that keeps its direction over a distance D behind the piece, because braking takes distance: with
/// its speed u, its deceleration y and jerk ≤ J, the quantity y² − 2 J u does not fall while the axis brakes. If it is
/// positive, the axis comes to rest, still braking, and reverses within u²/(2 √(y² − 2 J u)). Therefore
///   y ≤ √(2 J u) + u²/(2 D).
/// If the acceleration at the end of the distance D is known to be at most y_end, y² − 2 J u is at most y_end² there
/// for an axis that brakes throughout, and y² ≤ 2 J u otherwise. Therefore
///   y ≤ √(2 J u + y_end²).
/// If joints on the distance allow steps of the acceleration, their sum is added to y. Backwards in time the bounds
/// hold for an axis that accelerates.
///
/// If some b is impossible on the piece, so are all larger values: a motion that exceeds b anywhere in the piece can be
/// slowed down uniformly until its largest value there is b, and it keeps all limits.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace bahnwerk::verify {

/// A distance, ahead or behind, over which an axis keeps its direction. The default values state that nothing is known.
struct AxisWay {
  double displacement = 0, steps = 0,
         end = std::numeric_limits<double>::infinity();  ///< distance, mm; sum of the steps of acceleration on it, and
                                                         ///< largest acceleration at its end, mm/s²
};

/// Returns the largest acceleration of an axis at speed u (mm/s), against its direction for the distance ahead, in its
/// direction for the distance behind; mm/s².
inline double most_braking(double u, double jerk, const AxisWay& w) {
  const double free = 2 * jerk * u;
  return w.steps + std::min(std::sqrt(free) + u * u / (2 * w.displacement), std::sqrt(free + w.end * w.end));
}

/// A piece of the path with N axes.
template <int N>
struct JerkCapPiece {
  using Row = std::array<double, N>;
  std::size_t axes = N;
  Row acceleration{}, jerk{};  ///< limits of the axes; jerk may be infinite
  std::array<AxisWay, N> ahead{},
      behind{};                        ///< distances of the axes from the end onwards, and from the beginning backwards
  double length = 0;                   ///< mm
  std::array<Row, 2> tangent{}, q2{};  ///< q′, q″ at both ends
  Row least{}, most{};        ///< bounds of |q′_k| over the whole piece; least is 0 where the axis may reverse
  Row displacement{};         ///< upper bound of |Δq_k|
  double rounding_error = 0;  ///< effect of rounding on a component of q′
  bool unit = false;          ///< whether |q′| = 1 and q″ ⟂ q′
};

/// The result of jerk_cap().
struct JerkCap {
  double cap = 0;     ///< largest b, mm²/s²
  double change = 0;  ///< bound of the change of b along the piece at that cap
};

/// Returns whether jerk may limit b to less than `most`, as far as the ends of the piece show. 20 ns for two axes.
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
