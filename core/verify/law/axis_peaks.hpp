#pragma once
/// True peaks of velocity, acceleration and jerk of every limited axis over a whole law, found in one sweep.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/verify/law/verifier.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk::verify {

/// The result of axis_peaks().
struct AxisPeaks {
  std::vector<Check> checks;      ///< velocity, acceleration, jerk of each limited axis
  std::vector<TooFast> too_fast;  ///< an entry for each motion between two rests in which a limit is exceeded
  /// |∫|dh/du|du − (s_end − s)| of a piece on a free-form segment, mm, relative to five times the resolution of the
  /// quadrature: 1e-11 of the piece and 2e-12 of the segment, and the rounding of s.
  Strained arc_length;
  /// Number of sampled intervals that an estimate decided instead of a proven bound; 0: every peak is an enclosure.
  std::size_t estimated = 0;
};

/// Returns the peaks of v_k = q′v, a_k = q″v² + q′a, j_k = q‴v³ + 3q″va + q′j, with q by arc length and the law's v, a,
/// j. Pieces of constant a are evaluated over the curve's parameter, where b = v² is linear in s and all functions
/// are smooth up to rest and cusps (the peaks of v_k² and j_k² are searched); pieces with jerk or snap over time.
/// Pieces with an invalid segment are skipped (another check reports them). Arcs on which a law repeats an earlier one,
/// every piece compared, are not searched again (core/verify/law/repeated_run.hpp).
///
/// Each peak is an enclosure: the interpolant's maximum plus a proven bound of its error
/// (core/verify/law/channel_bounds.hpp), from the curve in the complex plane (curve_disc.hpp), but for the rounding of
/// the samples. Exceptions, in which the decay of Chebyshev coefficients decides (`estimated` counts them): next to a
/// place where the curve's tangent vanishes, laws of changing acceleration, laws that do not rest there, and jerk where
/// it vanishes to an order above 1; axes whose kinematics has no complex_bounds(); and where halving ends (2⁻⁴⁰ of a
/// piece) before any bound is finite.
AxisPeaks axis_peaks(const VerifierInput& input, ProgressScope& progress);

}  // namespace bahnwerk::verify
