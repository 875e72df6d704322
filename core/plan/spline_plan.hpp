#pragma once
/// Axes that follow splines in time, as a problem of the pipeline: no path, any number of axes.
#include <functional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/plan/pipeline.hpp"

namespace bahnwerk {

struct SplinePlanning {
  std::vector<SplineMotion::Piece> pieces;  ///< pieces as planned, from rest to rest
  Machine machine;                          ///< machine with as many axes and with limits up to the snap
  int continuous = 3;                       ///< order up to which derivatives are continuous
  int columns = 2;                          ///< order up to which the setpoints have columns of derivatives, 0 to 4
  Bound bound;
  /// Makes additional checks of the planned motion; empty: none.
  std::function<std::vector<Check>(const Motion&)> more_checks = {};
  double max_setpoints = 20'000'000;
};

/// Slows the motion to whole cycles, verifies it (core/verify/motion/motion_checks.hpp) and samples it. A limit
/// exceeded by at most 1e-4 of itself slows the whole motion accordingly. The returned plan may fail verification.
/// Throws what SplineMotion and the pipeline throw.
MotionPlan plan_spline(const SplinePlanning& planning, Progress progress);

}  // namespace bahnwerk
