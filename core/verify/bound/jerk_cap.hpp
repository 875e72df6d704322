#pragma once
/// The largest b = v² that limits of jerk leave on a short piece of the path.
///
/// Over a piece that takes the time T the acceleration of axis k, q″_k b + q′_k v̇, changes by no more than J_k T. The
/// sum of two axes' accelerations weighted by q′_m and −q′_k of the middle hardly contains v̇; in what is left, P b with
/// P = Σ weight · q″, P is known at both ends. A fast motion passes in little time, and b cannot change much: where P
/// does, it is too fast. That is what slows a motion where curvature sets in: the convex problem in v² would let time
/// pass there instead.
///
/// How much b changes: q′_k² b by no more than 2 Y_k |Δq_k|, with Y_k the largest acceleration of an axis; where q′ is
/// a unit vector b by no more than 2 Σ |q′_k| Y_k per length. Y_k ≤ A_k, and an axis that goes on in its direction for
/// `way` mm more cannot brake as it likes. With u its speed, y its deceleration and jerk ≤ J, y² − 2 J u does not fall
/// while it brakes; so it would come to rest, still braking, and turn round, within u²/(2 √(y² − 2 J u)). Hence
///   y ≤ √(2 J u) + u²/(2 way).
/// And where the way ends, at a place that it reaches with its direction still the same, its acceleration is no more
/// than some y_end: if it brakes all the way y² − 2 J u is no more than y_end² there, and if it does not y² ≤ 2 J u, so
///   y ≤ √(2 J u + y_end²).
/// Joints at which its acceleration may step add these steps, s in all: y less the steps to come has the same growth.
/// The same holds backwards in time for an axis that speeds up.
///
/// A motion that reaches more than some b anywhere in the piece can be slowed down to reach just that, and keeps all
/// limits. So if that is impossible, more is, too.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace bahnwerk::verify {

/// How far an axis goes on in its direction, mm, the sum of the steps of its acceleration on that way, and its largest
/// acceleration at the end of it, mm/s². None: nothing is known.
struct AxisWay {
  double way = 0, steps = 0, end = std::numeric_limits<double>::infinity();
};

/// The largest acceleration of an axis at speed u against (ahead) or in (behind) its direction, mm/s².
inline double most_braking(double u, double jerk, const AxisWay& w) {
  const double free = 2 * jerk * u;
  return w.steps + std::min(std::sqrt(free) + u * u / (2 * w.way), std::sqrt(free + w.end * w.end));
}

template <int N>
struct JerkCapPiece {
  using Row = std::array<double, N>;
  std::size_t axes = N;
  Row acceleration{}, jerk{};                ///< limits; jerk may be infinite
  std::array<AxisWay, N> ahead{}, behind{};  ///< of its end, of its begin
  double length = 0;                         ///< mm
  std::array<Row, 2> tangent{}, bend{};      ///< q′, q″ at both ends
  Row least{}, most{};                       ///< of |q′_k| all along; least 0 where it may turn round
  Row way{};                                 ///< |Δq_k| at most
  double blur = 0;                           ///< how far rounding may have moved a component of q′
  bool unit = false;                         ///< |q′| = 1, and q″ ⟂ q′
};

struct JerkCap {
  double cap = 0;     ///< mm²/s²
  double change = 0;  ///< by how much b may change along the piece if it comes to that
};

/// Whether jerk may leave less than `most`: what the ends alone say. 20 ns for two axes.
template <int N>
bool jerk_may_limit(const JerkCapPiece<N>& piece, double most);

/// No more than `most`, which is finite; from above, to 2e-3 where `most` is a thousand times
/// that. 0.05 µs for two axes where `most` is possible, 0.5 µs
/// where not.
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
