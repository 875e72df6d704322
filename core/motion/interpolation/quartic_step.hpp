#pragma once
/// One step of the polynomial interpolator [Herrmann 4.4.1, appendix B].
#include <optional>

#include "core/motion/interpolation/piece_series.hpp"

namespace bahnwerk {

/// The least Δu ∈ (0, most] at which the curve, numerator and denominator developed to their second order (4.65), is
/// `length` away from where it is at u: the least positive root of
///
///   ‖Z′ Δu + Z″ Δu²/2‖² = l² (N + N′ Δu + N″ Δu²/2)²,   Z without the curve's own point, times N,
///
/// which is appendix B with its misprints corrected (−2 l² N³ N″ in a_2, a half of a_3, a quarter of a_4). Nothing
/// where there is none: the developed curve does not come so far within `most`. The root is found by Newton's method in
/// a bracket, to 1e-15 of it, usually in four steps: Ferrari's formula, which the source uses, loses half of the digits
/// where the step is short. `length` and `most` above 0, |Z′| above 0. No allocation.
std::optional<double> quartic_step(const QuotientJet& at, double length, double most);

}  // namespace bahnwerk
