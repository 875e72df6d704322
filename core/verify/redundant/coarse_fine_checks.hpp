#pragma once
/// The verifier of a head's motion that is the sum of coarse and fine axes: what either axis does between samples. It
/// sees the path, the law and the coarse motion; the fine axes are the rest, x_f = x − x_c.
#include <vector>

#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

class Progress;

struct CoarseFineToVerify {
  const AxisPath& path;                                  ///< Cartesian
  const TimeLaw& law;                                    ///< of the head, as it will be sampled
  const Motion& coarse;                                  ///< as many axes as the path has, as long as the law
  const std::vector<AxisLimits>&coarse_axes, fine_axes;  ///< limits and names; a fine axis' stroke is its `highest`
  bool check_jerk = false;  ///< jerk limits hold, and the coarse acceleration is continuous
  double cycle_time =
      0;  ///< s; a coarse axis without a fine one takes steps at a tangent jump as a machine's axis does
  double progress_from = 0, progress_to = 1;
};

/// Checks, in this order: motion_checks() of the coarse motion (at a resolution of ε times the duration), those of its
/// pieces and rests with `coarse ` before their names; per axis `stroke <fine axis>` (|x − x_c|), `velocity <fine
/// axis>`, `acceleration <fine axis>`, with check_jerk `jerk <fine axis>`; `coarse duration` (against the law's:
/// rounding).
///
/// An axis whose `highest` is 1e-8 mm at most (least_stroke) has no fine one: its coarse axis is an ordinary axis of a
/// machine. Where segments of the path meet its velocity may jump by what the jump of the tangent makes of the head's
/// speed, acceleration times cycle time at most (its acceleration by what tangent and curvature make of speed and
/// acceleration, jerk times cycle time at most). Nothing else of it jumps, and nothing of any other coarse axis, but
/// what the path's own joints do by rounding: positions by that of what the curve is computed with (its radius, its
/// length, its distance from zero, 32 ε of them; within a segment, too, where pieces of the law meet), tangents and
/// curvatures by what that turns and bends the segment's end (times 1/length + 1/radius, and its square). Where pieces
/// of the law meet in a bend velocities may also differ by what the rounding of the path length there (rounding.hpp) is
/// bent by: at 1.3 mm/s, 15 mm along a path, in a bend of 15 µm that is 1e-11 mm/s.
///
/// Head and coarse motion are looked at together on every piece of time on which both are smooth. Where the segment is
/// linear and the coarse motion a polynomial their difference is one: its peak is an enclosure by Bernstein
/// coefficients. On curves it is interpolated, and how far the interpolant may be off is proven from how curve and law
/// grow in the complex plane (core/verify/law/channel_bounds.hpp); a polynomial of degree 8 at most is interpolated
/// without error. So every peak is an enclosure up to rounding, but for pieces next to a vanishing tangent and coarse
/// motions that are not polynomials, where the decay of Chebyshev coefficients decides. Pieces of time shorter than
/// what rounding does to t (32 ε t) are left out.
///
/// Cost: 1 to 4 µs per piece of time and axis. Throws std::invalid_argument where axes differ in number or the path is
/// not Cartesian, and what progress throws.
std::vector<Check> coarse_fine_checks(const CoarseFineToVerify& input, Progress& progress);

}  // namespace bahnwerk
