#pragma once
/// A step of the polynomial interpolator [Herrmann 4.4.1, appendix B].
#include <optional>

#include "core/motion/interpolation/piece_series.hpp"

namespace bahnwerk {

/// Returns the least Δu ∈ (0, most] at which the curve, numerator and denominator expanded to second order (4.65), is
/// `length` away from its point at u: the least positive root of
///
///   ‖Z′ Δu + Z″ Δu²/2‖² = l² (N + N′ Δu + N″ Δu²/2)²,   Z without the curve's own point, times N,
///
/// which is appendix B with its misprints corrected (−2 l² N³ N″ in a_2, a half of a_3, a quarter of a_4). Returns
/// nothing if there is no root within `most`. The root is found by Newton's method in a bracket, to 1e-15 of it,
/// usually in four steps: Ferrari's formula, which the source uses, loses half of the digits of short steps. `length`,
/// `most` and |Z′| are positive. No allocation.
std::optional<double> quartic_step(const QuotientJet& at, double length, double most);

}  // namespace bahnwerk
