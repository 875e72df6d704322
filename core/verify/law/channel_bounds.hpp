#pragma once
/// Proven bounds of the error of an interpolant in Chebyshev points for the motion of an axis on a piece of a law, from
/// the growth of curve and law in the complex plane.
#include <array>

#include "core/motion/law/time_law.hpp"
#include "core/verify/law/curve_disc.hpp"

namespace bahnwerk::verify {

/// The functions whose peaks are searched: v², a and j² of one axis, with h by arc length and the law's v, a, j.
enum class ChannelQuantity { velocity, acceleration, jerk };
/// A bound of each quantity, valid for every coordinate of the tool; infinite where unknown.
using ChannelBounds = std::array<double, 3>;

/// Returns bounds for a piece of constant acceleration `a`, over the curve's parameter: an interval of half width
/// `half` about the disc's centre, on which v² ≤ `fastest`. v_k² = h′²b, a_k = h″b + h′a, j_k² = b (h‴b + 3h″a)² with b
/// = v² linear in s: |b| ≤ fastest + 2|a| max|ds/du| radius on the disc. `even` says that s is linear in u; otherwise s
/// at the points is integrated from as many samples of the speed, and its error in b counts with the interpolant's
/// Lebesgue constant.
ChannelBounds bounds_over_parameter(double fastest, double a, double half, const CurveDisc& disc, int points,
                                    bool even);

/// Returns bounds on an interval that begins at a vanishing tangent of order m = `vanishing`, where the motion rests:
/// with z the distance from that place, s ~ z^(m+1), so b = 2as, h″b + h′a and for m = 1 b (h‴b + 3h″a)² are analytic
/// although h″ ~ z^−m and h‴ ~ z^(−2m−1) need not be. `disc` is CurveDiscs::at_vanishing_tangent(). For the open rule
/// of 9 points only.
ChannelBounds bounds_from_rest(double a, double half, const CurveDisc& disc, std::size_t vanishing);

/// Returns the piece as a polynomial about τ instead of its beginning. `duration` and `s_end` are unchanged.
LawPiece moved(const LawPiece& piece, double tau);

/// Returns bounds for a piece whose acceleration changes, over time: τ ∈ [−half, half], the disc about u(s(0)). v_k² =
/// (h′v)², a_k = h″v² + h′a, j_k² = (h‴v³ + 3h″va + h′j)². While |τ| ≤ r, s moves by at most S(r) = |v|r + |a|r²/2 +
/// |j|r³/6 + |snap|r⁴/24, and u by at most S(r) max|du/ds|, which has to stay in the disc.
ChannelBounds bounds_over_time(const LawPiece& piece, double half, const CurveDisc& disc, int points);

/// Bounds of position, velocity, acceleration and jerk, mm, mm/s …: for functions to which a polynomial is added before
/// their peak is searched. |h(s) − h(s(0))| ≤ |h′| S(r).
using StateBounds = std::array<double, 4>;
StateBounds state_bounds_over_time(const LawPiece& piece, double half, const CurveDisc& disc, int points);

}  // namespace bahnwerk::verify
