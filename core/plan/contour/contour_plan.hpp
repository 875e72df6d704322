#pragma once
/// The plan of a contour: time law, setpoints, verification and proven bound.
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/tool_machine.hpp"
#include "core/plan/contour/section_gaps.hpp"
#include "core/plan/contour/slow_lines.hpp"
#include "core/plan/method_options.hpp"

namespace bahnwerk {

class ContourAxes;
class PathMotion;

enum class CornerMode { stop, blend };

struct ContourPlanning : MethodOptions {
  PlanningMethod method = PlanningMethod::braking_reserve;
  CornerMode corner_mode = CornerMode::stop;
  double blend_tolerance = 0;  ///< mm, tolerance of CornerMode::blend
  double max_setpoints = 20'000'000;
  bool stop_at_mode_change = false;  ///< whether the motion rests between cutting and positioning
  bool what_if = false;              ///< whether to compute durations under other limits
  bool machine_study = false;        ///< whether to compute durations with other fine axes, if the machine has such
};

struct BlockReport {
  Mode mode = Mode::cut;
  double start_time = 0, end_time = 0;  ///< s, in the time of the setpoints
  double length = 0;                    ///< mm
};

/// A joint with a tangent jump below the corner angle, passed at speed.
struct SmallJoint {
  double s = 0;              ///< mm
  double angle = 0;          ///< rad
  double velocity = 0;       ///< mm/s
  std::vector<double> step;  ///< velocity step per axis, mm/s
};

/// The duration with one kind of limit changed, all else being equal (core/plan/contour/what_if.hpp).
struct WhatIf {
  enum class What { tolerance, jerk, acceleration } what = What::tolerance;
  double factor = 1;               ///< factor of the limit
  std::optional<double> duration;  ///< s; none if no plan exists with this limit
};

struct ContourPlan {
  std::unique_ptr<SetpointSource> setpoints;
  std::shared_ptr<const Contour> path;  ///< the driven contour, after blending
  /// The motion that the setpoints sample; null where coarse and fine axes have it (CoarseFinePlan::head).
  std::shared_ptr<const PathMotion> motion;
  std::shared_ptr<const ContourAxes>
      axes;  ///< how the motion's axes follow the contour; null with coarse and fine axes
  Verification verification;
  Bound bound;
  double duration = 0, cut_time = 0, position_time = 0;  ///< s, planned
  double path_length = 0;                                ///< mm, length of the driven contour
  std::size_t iterations = 0;                            ///< passes of the planner over its grid
  std::size_t pieces = 0;                                ///< pieces of the time law
  std::vector<BlockReport> blocks;
  std::vector<SmallJoint> joints;
  std::vector<SlowLine> slow_lines;  ///< the 20 source lines that take most time, in the time of the setpoints
  SectionGaps sections;              ///< sections between rests compared with their own bounds
  std::vector<WhatIf> what_if;       ///< effect of changed limits, if requested
  std::vector<std::string> notes;
};

/// Returns the verified plan of `contour`.
///
/// A planar contour may run on a machine with more axes: those stand still in every setpoint and affect neither plan
/// nor bound.
///
/// A machine with kinematics follows the contour by its axes (core/plan/contour/contour_axes.hpp): their limits hold,
/// setpoints have axes and tool, and the verification compares both by the machine's forward kinematics
/// (core/verify/setpoints/tool_checks.hpp). Limits of path and feeds are the tool's. Throws UnreachablePose where it
/// does not reach, or is singular.
///
/// With CornerMode::blend the contour is rounded first where that makes it quicker
/// (core/plan/contour/rounding_choice.hpp), and the verification includes its deviation from the given contour. Cost,
/// errors and checks are those of the pipeline (core/plan/path_plan.hpp); in addition it is verified that the motion
/// rests where, and as long as, the contour requires.
///
/// Also throws InvalidInput naming every fault of machine and planning (core/plan/contour/contour_faults.hpp).
ContourPlan plan_contour(Contour contour, const ToolMachine& machine, const ContourPlanning& planning,
                         Progress progress);
/// Plans without a progress report.
ContourPlan plan_contour(Contour contour, const ToolMachine& machine, const ContourPlanning& planning = {});

}  // namespace bahnwerk
