#pragma once
/// Checks feeds that the path's curvature limits [Herrmann (4.71), (4.72)] on the sampled motion, independently of how
/// the feeds were found.
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Inputs of the checks.
struct CurvatureInput {
  const AxisPath& path;
  const TimeLaw& law;                       ///< the law that is sampled
  double cycle_time = 0.001;                ///< s
  double chord_tolerance = unlimited;       ///< largest distance of path and chord, mm
  double half_speed_curvature = unlimited;  ///< κ̂, 1/mm
  double velocity = unlimited;              ///< v_max, mm/s
};

/// Returns these checks, over four places of every cycle:
///
/// `chord error`       mm    distance of the path from the chord between two setpoints, against the tolerance
/// `half-speed feed`   mm/s  v (κ̂ + κ)/κ̂ against v_max
///
/// Each check exists where its quantity is limited. About 1 µs per setpoint.
std::vector<Check> curvature_checks(const CurvatureInput& input, Progress progress);

}  // namespace bahnwerk
