#pragma once
/// True peaks of velocity, acceleration and jerk of every limited axis over a whole law, found in one sweep.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/verify/verifier.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk::verify {

struct AxisPeaks {
  std::vector<Check> checks;  ///< velocity, acceleration, jerk of each limited axis
  /// |∫|dh/du|du − (s_end − s)| of a piece on a free-form segment, mm, against five times what the quadrature resolves:
  /// 1e-11 of the piece and 2e-12 of the segment, and the rounding of s.
  Strained arc_length;
};

/// With h by arc length and the law's v, a, j: v_k = h'v, a_k = h''v² + h'a, j_k = h'''v³ + 3h''va + h'j.
/// Pieces of constant a are followed over the curve's parameter, where b = v² is linear in s and everything is smooth
/// up to rest and cusps (v_k² and j_k² are searched); pieces with jerk or snap over time. Pieces with an invalid
/// segment are left out (another check's fault).
AxisPeaks axis_peaks(const VerifierInput& input, ProgressScope& pulse);

}  // namespace bahnwerk::verify
