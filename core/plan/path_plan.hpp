#pragma once
/// Axes that follow a path, as a problem of the pipeline (core/plan/pipeline.hpp): time law, whole cycles,
/// verification, bound, setpoints, with refinement of the grid where needed. A kind supplies the geometry and writes
/// the report.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/setpoints/cycles.hpp"
#include "core/plan/planning_method.hpp"
#include "core/verify/bound/lower_bound.hpp"

namespace bahnwerk {

struct PathPlanning {
  std::shared_ptr<const AxisPath> path;  ///< axis path with every axis of the machine
  /// Axis path of the moving axes only, if the machine's last axes stand still and limit nothing; otherwise equal to
  /// `path`.
  std::shared_ptr<const AxisPath> moving;
  Machine machine;            ///< every axis, with the limits that the method keeps (held_limits)
  std::vector<double> feeds;  ///< largest tool speed of each segment for the planner, mm/s; infinite where not limited
  /// The document's feeds of each segment, mm/s, which the verifier checks; equal to `feeds` unless a step in between
  /// changed those.
  std::vector<double> feeds_to_verify;
  std::vector<bool>
      rests;  ///< whether the motion rests at the begin of each segment, and at the end of the path (one more entry)
  std::vector<Rest> dwells;  ///< rests of given durations, ordered by segment
  MethodRow method = method_row(PlanningMethod::braking_reserve);
  MethodOptions options;
  double max_setpoints = 20'000'000;
  /// Share of every axis' jerk limit with which the method plans. Verification and bound use the whole limit.
  double jerk_share = 1;
  /// Whether only the duration is needed: no setpoints are made, and the bound is computed only if the method needs it.
  bool only_duration = false;
  const Contour* blocks =
      nullptr;  ///< contour whose blocks appear in the setpoints' columns mode and block, if they have such
  /// Makes a kind's own setpoints, derived from PathSetpoints; empty: PathSetpoints themselves.
  std::function<std::unique_ptr<SetpointSource>(const std::shared_ptr<const PathMotion>&, std::size_t cycles)>
      setpoints;
  /// Makes a kind's own checks of rows for a motion and its verdict; empty: none. They see the rows in the pipeline's
  /// one pass.
  std::function<RowChecks(const PathMotion&, const SetpointSource&, const Verification&)> row_checks = {};
  /// Factor of each axis from its unit to that of the setpoints' columns, such as 180/π for rad shown in deg; empty: 1.
  std::vector<double> shown;
  /// Largest distance of these setpoints from the law's place (SetpointInput::lag).
  double lag = 0;
};

struct PathPlan {
  double duration = 0;     ///< s, duration as planned, including dwells
  std::size_t pieces = 0;  ///< pieces of the time law
  Cycles cycles;
  std::shared_ptr<const PathMotion> motion;  ///< the motion slowed to whole cycles, which is verified and sampled
  std::unique_ptr<SetpointSource> setpoints;
  Verification verification;
  RowChecks row_checks;  ///< checks made by PathPlanning::row_checks after all rows; their verdicts are for the kind
  Bound bound;           ///< bound with its gap to the law as planned
  std::vector<SectionBound> section_bounds;
  std::size_t iterations = 0;  ///< passes of the planner over its grid
};

/// Plans, verifies and samples a motion along a path. The verification covers the motion
/// (core/verify/law/verifier.hpp), every setpoint (core/verify/setpoints/setpoint_checks.hpp), and that the duration is
/// not below its bound. The plan is repeated on a finer grid, at most three times, if the verifier rejects it, or if
/// its method converges to the bound and the gap is above 5e-6 (for at most 20 000 cells: above 5e-7, while finer grids
/// gain 2e-7; with a braking reserve while they change the duration by that). The returned plan may still fail
/// verification: see `verification.passed`. A limit exceeded by rounding only slows the section accordingly.
///
/// `first` is the method's law of this path on its first grid, if an earlier stage has planned it.
///
/// Cost: that of the method, about 1 µs per grid cell for verification and bound, and 0.1 to 0.3 µs per setpoint.
/// Throws InvalidInput, also for a motion of more than max_setpoints, UnreachablePose and Stopped.
PathPlan plan_along(const PathPlanning& planning, Progress progress, std::optional<MethodResult> first = {});

}  // namespace bahnwerk
