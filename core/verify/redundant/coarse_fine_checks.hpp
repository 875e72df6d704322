#pragma once
/// The verifier of a head's motion that is the sum of coarse and fine axes: it encloses what both do over continuous
/// time. It is given path, time law and coarse motion; the fine axes are the difference, x_f = x − x_c.
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

namespace quantity {
inline constexpr Quantity stroke{"stroke", CheckGroup::limit, true};  ///< the position of a fine axis
}

struct CoarseFineToVerify {
  const AxisPath& path;                                  ///< Cartesian
  const TimeLaw& law;                                    ///< time law of the head, as it will be sampled
  const Motion& coarse;                                  ///< as many axes as the path has, as long as the law
  const std::vector<AxisLimits>&coarse_axes, fine_axes;  ///< limits and names; a fine axis' stroke is its `highest`
  int order = 2;  ///< highest derivative whose limits have to hold; the coarse axes' next lower one is continuous
  double cycle_time = 0;  ///< s; a coarse axis under a fine one that stands still takes steps at a tangent jump as a
                          ///< machine's axis does
};

/// Returns, in this order: motion_checks() of the coarse motion (at a resolution of ε times the duration), where the
/// names of checks of pieces and rests begin with `coarse `; per axis `stroke <fine axis>` (|x − x_c|), `velocity <fine
/// axis>`, `acceleration <fine axis>`, with order 3 `jerk <fine axis>`; `coarse duration` (equal to the law's up to
/// rounding).
///
/// Jumps. Where the fine axis moves by at most 1e-8 mm (least_stroke) all the time, because there is none or because it
/// stands still, the coarse axis is an ordinary axis of a machine. At a joint its velocity may jump by the tangent jump
/// times the head's speed, at most acceleration times cycle time, and its acceleration by what the jumps of tangent and
/// curvature cause, at most jerk times cycle time. All other coarse axes, and all other places, allow only jumps due to
/// rounding of the path: positions by the rounding of the curve's data (32 ε of its length, its distance from zero, an
/// arc's radius; also where pieces of the law meet inside a segment), tangents and curvatures by what such a shift
/// turns and bends the segment's end (times 1/length + 1/radius, and its square). Where pieces of the law meet on a
/// curved segment, velocities may also differ by the curvature times the rounding of path length there (rounding.hpp):
/// at 1.3 mm/s, 15 mm along a path, on a radius of 15 µm that is 1e-11 mm/s.
///
/// Peaks. Head and coarse motion are examined together on every interval of time on which both are smooth. Where the
/// segment is linear and the coarse motion polynomial, their difference is polynomial and its peak is enclosed by
/// Bernstein coefficients. On curved segments the difference is interpolated, and the error of interpolation is bounded
/// by the growth of curve and law in the complex plane (core/verify/law/channel_bounds.hpp); polynomials of degree at
/// most 8 are interpolated exactly. Every peak is thus an enclosure up to rounding, except in pieces next to a
/// vanishing tangent and for coarse motions that are not polynomial, where the error is estimated from the decay of
/// Chebyshev coefficients. Intervals shorter than the rounding of t (32 ε t) are left out.
///
/// Cost: 1 to 4 µs per interval and axis. Throws std::invalid_argument if numbers of axes differ or the path is not
/// Cartesian, and what `progress` throws.
std::vector<Check> coarse_fine_checks(const CoarseFineToVerify& input, Progress progress);

}  // namespace bahnwerk
