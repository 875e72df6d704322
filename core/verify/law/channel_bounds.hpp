#pragma once
/// How far an interpolant in Chebyshev points may be from what an axis does on a piece of a law: proven, from how the
/// curve and the law grow in the complex plane.
#include <array>

#include "core/motion/law/time_law.hpp"
#include "core/verify/law/curve_disc.hpp"

namespace bahnwerk::verify {

/// What is searched for its peak: v², a and j² of one axis, with h by arc length and the law's v, a, j.
enum class Quantity { velocity, acceleration, jerk };
/// Per quantity, for every coordinate of the tool; infinite where nothing can be said.
using ChannelBounds = std::array<double, 3>;

/// On a piece of constant acceleration `a`, over the curve's parameter: an interval of half width `half` about the
/// disc's centre, on which v² ≤ `fastest`. v_k² = h′²b, a_k = h″b + h′a, j_k² = b (h‴b + 3h″a)² with b = v² linear in
/// s: |b| ≤ fastest + 2|a| max|ds/du| radius on the disc. `even`: s is linear in u; else s at the points is itself
/// integrated from as many samples of the speed, and what that may miss in b counts with the interpolant's Lebesgue
/// constant.
ChannelBounds bounds_over_parameter(double fastest, double a, double half, const CurveDisc& disc, int points,
                                    bool even);

/// The same on an interval from a vanishing tangent of order m = `vanishing` on, where the motion rests: with z the
/// distance from there, s ~ z^(m+1), so b = 2as, h″b + h′a and for m = 1 b (h‴b + 3h″a)² are analytic though h″ ~ z^−m
/// and h‴ ~ z^(−2m−1) need not be. `disc`: CurveDiscs::at_vanishing_tangent(). For the open rule of 9 points alone.
ChannelBounds bounds_from_rest(double a, double half, const CurveDisc& disc, std::size_t vanishing);

/// The law moved to begin at τ: the same polynomial about another place. `duration` and `s_end` are left as they are.
LawPiece moved(const LawPiece& piece, double tau);

/// On a piece whose acceleration changes, over time: τ ∈ [−half, half], the disc about u(s(0)). v_k² = (h′v)²,
/// a_k = h″v² + h′a, j_k² = (h‴v³ + 3h″va + h′j)². While |τ| ≤ r, s moves by no more than
/// S(r) = |v|r + |a|r²/2 + |j|r³/6 + |q|r⁴/24, and u by no more than S(r) max|du/ds|, which has to stay in the disc.
ChannelBounds bounds_over_time(const LawPiece& piece, double half, const CurveDisc& disc, int points);

/// The same of position, velocity, acceleration and jerk themselves, mm, mm/s …: of what a polynomial is added to
/// before its peak is looked for. |h(s) − h(s(0))| ≤ |h′| S(r).
using StateBounds = std::array<double, 4>;
StateBounds state_bounds_over_time(const LawPiece& piece, double half, const CurveDisc& disc, int points);

}  // namespace bahnwerk::verify
