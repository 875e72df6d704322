#pragma once
/// Axes that follow a path as a problem of the pipeline (core/plan/pipeline.hpp): time law, whole cycles, verification,
/// bound, setpoints, with refinement on demand. A kind brings the geometry before it and the report behind it.
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

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

class Progress;

struct PathPlanning {
  std::shared_ptr<const AxisPath> path;  ///< of every axis of the machine
  /// The axes that move, if the machine's last ones stand still all the time: they limit nothing. Else as `path`.
  std::shared_ptr<const AxisPath> moving;
  Machine machine;
  std::vector<double> feeds;  ///< per segment: the tool's speed that is planned, mm/s, infinite where not limited
  /// Per segment: what the verifier holds the motion to, from the document; the same where nothing came between.
  std::vector<double> feeds_to_verify;
  std::vector<bool> rests;   ///< per segment, whether the motion rests at its begin; and one for the end of the path
  std::vector<Rest> dwells;  ///< by segment
  PlanningMethod method = PlanningMethod::braking_reserve;
  MethodOptions options;
  double max_setpoints = 20'000'000;
  std::shared_ptr<MethodResult> planned;  ///< the method's first law, if it is known already: it is taken from here
  /// The share of every axis' jerk limit that the method plans with. Verification and bound are by the whole limit.
  double jerk_share = 1;
  /// No setpoints are made, and the bound only where the method needs it: for the duration alone.
  bool only_duration = false;
  const Contour* blocks = nullptr;  ///< whose blocks the setpoints' columns mode and block tell, if they have such
  /// What a kind derives from PathSetpoints; those themselves if it is empty.
  std::function<std::unique_ptr<SetpointSource>(const std::shared_ptr<const PathMotion>&, std::size_t cycles)>
      setpoints;
  /// Checks of rows that the kind has besides, made for a motion with its verdict; none if it is empty. They look at
  /// the rows in the pipeline's one pass.
  std::function<RowChecks(const PathMotion&, const SetpointSource&, const Verification&)> row_checks = {};
  /// Per axis: what one of its units is in the setpoints' columns, such as 180/π for rad shown in deg; empty: 1.
  std::vector<double> shown;
  /// By how much these setpoints may be off the law's place (SetpointInput::lag).
  double lag = 0;
  double from = 0, to = 1;  ///< the share of the whole job's progress that this takes
};

struct PathPlan {
  double duration = 0;     ///< s, as planned, dwells included
  std::size_t pieces = 0;  ///< of the law
  Cycles cycles;
  std::shared_ptr<const PathMotion> motion;  ///< slowed to whole cycles: what is verified and sampled
  std::unique_ptr<SetpointSource> setpoints;
  Verification verification;
  RowChecks
      row_checks;  ///< those of PathPlanning::row_checks, which have seen all rows; their verdicts are for the kind
  Bound bound;     ///< with its gap to the law as planned
  std::vector<SectionBound> section_bounds;
  std::size_t iterations = 0;  ///< passes of the planner over its grid
};

/// Verified are the motion (core/verify/verifier.hpp), every setpoint (core/verify/setpoints/setpoint_checks.hpp), and
/// that the duration is not below its bound. A plan of a method that reaches the bound but is not within 5e-6 of it (of
/// 20 000 cells at most: 5e-7, while finer grids gain 2e-7, with a braking reserve while they change it by that), and
/// any plan that the verifier rejects, is planned again on a finer grid, three times at most; what is returned may
/// still be unverified: look at `verification.passed`. A limit exceeded by so little that it is rounding slows the
/// section by as much.
///
/// Cost: that of the method, about 1 µs per grid cell with verification and bound, and 0.1 to 0.3 µs per setpoint.
/// Throws InvalidInput, also for a motion of more than max_setpoints, UnreachablePose and Stopped.
PathPlan plan_along(const PathPlanning& planning, Progress& progress);

}  // namespace bahnwerk
