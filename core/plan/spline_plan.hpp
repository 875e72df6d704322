#pragma once
/// Axes that follow splines in time as a problem of the pipeline: no path, any number of axes.
#include <functional>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/plan/pipeline.hpp"

namespace bahnwerk {

class Progress;

struct SplinePlanning {
  std::vector<SplineMotion::Piece> pieces;  ///< as planned, from rest to rest
  Machine machine;                          ///< limits, up to the snap, of as many axes
  int continuous = 3;                       ///< up to which derivative pieces fit together
  int columns = 2;                          ///< up to which derivative the setpoints have columns, 0 to 4
  Bound bound;
  /// What is checked besides of the motion that is served; nothing if it is empty.
  std::function<std::vector<Check>(const Motion&)> more_checks = {};
  double max_setpoints = 20'000'000;
};

/// Slows the motion to whole cycles, verifies it (core/verify/motion/motion_checks.hpp), and samples it. A limit that
/// is exceeded by 1e-4 of itself at most slows the whole motion by as much. What is returned may be unverified. Throws
/// what SplineMotion and the pipeline throw.
MotionPlan plan_spline(const SplinePlanning& planning, Progress& progress);

}  // namespace bahnwerk
