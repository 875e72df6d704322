#pragma once
/// The independent verifier of a finished motion law: it shares the geometry with the planner and nothing else.
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Axes that follow a path by a time law, 1 to max_axes of them.
struct VerifierInput {
  const AxisPath& path;
  const Machine& machine;     ///< limits of the path's axes, in its order
  const TimeLaw& law;         ///< the law that is sampled
  std::vector<double> feeds;  ///< largest speed of the tool per segment, mm/s; infinite where not limited
  std::vector<bool> rests;    ///< whether the motion rests at the beginning of each segment; one more for the end
  double corner_angle = 0;    ///< largest jump of the tool's tangent without a stop, rad
  int order = 2;              ///< highest derivative of the axes that is verified: 2, or 3 with related checks
  Limits along = {};          ///< limits along the tool's path
  double position_tolerance = 1e-6;  ///< allowed gap of curves at a joint, mm
};

/// A contour on a Cartesian machine: axis k is coordinate k of the tool.
struct ContourVerifierInput {
  const Contour& contour;  ///< the driven path
  const Machine& machine;  ///< 1 to 3 axes
  const TimeLaw& law;
  double corner_angle = 0;
  int order = 2;
  Limits path = {};                  ///< limits along the path
  const Contour* given = nullptr;    ///< contour whose feeds hold for the blocks of `contour`, if another
  double position_tolerance = 1e-6;  ///< allowed gap of curves at a joint, mm
};

/// Returns the feeds per path segment, mm/s. A path driven in place of the given contour has to keep that contour's
/// feeds; a segment that belongs to none of its blocks may not be driven at all: 0.
std::vector<double> feeds_to_hold(const Contour& driven, const Contour& given);

/// Verifies a law along its path. Peaks over time are enclosures, never below the true continuous peak but for the
/// rounding of the evaluated terms: in closed form where the axes are linear in s and for path velocity; on curves by
/// interpolation with a proven bound of its error (core/verify/law/axis_peaks.hpp, which names the exceptions),
/// resolved to 2e-11 of the limit, and to outer bounds where halving ends. The arc length is not enclosed: two
/// quadratures of different kinds have to agree. A limit of the document holds when value ≤ limit · (1 + 1e-9); all
/// other tolerances are the rounding of the pieces (core/verify/rounding.hpp), each reported with the value closest to
/// it. A value that is not a number fails its check; no law makes the verifier crash.
///
/// The checks, in this order:
///   - `velocity <axis>`, `acceleration <axis>`, `jerk <axis>`, for limited axes;
///   - `path velocity (feed F)` per distinct finite feed (of `given`, if that is set);
///   - `path velocity`, `path acceleration`, `path jerk`, `path snap` where limited (the last two with order 3);
///   - `velocity step at joints`: |Δq′|·v against acceleration · cycle time, for the worst axis and joint;
///   - with order 3 `acceleration step at joints`: |Δ(q″v² + q′a)| against jerk · cycle time, for the worst joint;
///   - `corner rest` (at the contour's rests, too), `cusp rest`, `start at rest`, `end at rest`;
///   - `continuity of velocity`; with order 3 `continuity of acceleration` (also zero at rests);
///   - `continuity of position`: law and path, the worse one in relation to its limit;
///   - `continuity of time`, `pieces within segments`, `forward motion`;
///   - `path covered`: 32 ε of the path's length;
///   - `distance from contour`: the law evaluated on the path, at the ends of segments, against position_tolerance and
///     32 ε of the coordinates;
///   - `arc length`: ∫|dh/du|du of every piece on a free-form segment, integrated here, against the length that the law
///     uses.
/// A piece of rest (v = a = j = 0, s = s_end) is a motion like any other: a dwell.
///
/// Cost: ≈ 50 ns per law piece on straight segments, ≈ 0.4 µs on arcs and cubics. Reports to `progress` every few ms.
/// Throws std::invalid_argument if axes, feeds or rests do not match the path.
Verification verify_motion(const VerifierInput& input, Progress progress);
/// Verifies a contour. Throws std::invalid_argument for more than three axes.
Verification verify_motion(const ContourVerifierInput& input, Progress progress);

}  // namespace bahnwerk
