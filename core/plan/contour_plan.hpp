#pragma once
/// From a contour to a verified plan: law, setpoints, the verifier's verdict and the proven bound.
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/plan/contour/section_gaps.hpp"
#include "core/plan/method_options.hpp"
#include "core/plan/slow_lines.hpp"

namespace bahnwerk {

class PathMotion;
class Progress;

enum class CornerMode { stop, blend };

struct ContourPlanning : MethodOptions {
  PlanningMethod method = PlanningMethod::braking_reserve;
  CornerMode corner_mode = CornerMode::stop;
  double blend_tolerance = 0;  ///< mm, of CornerMode::blend
  double max_setpoints = 20'000'000;
  bool stop_at_mode_change = false;  ///< whether the head rests where cutting and positioning meet
  bool what_if = false;              ///< whether to tell what other limits would bring
  bool machine_study = false;        ///< the same of other fine axes, of machines that have such
};

struct BlockReport {
  Mode mode = Mode::cut;
  double start_time = 0, end_time = 0;  ///< s, in the time of the setpoints
  double length = 0;                    ///< mm
};

/// A tangent jump below the corner angle, passed at speed.
struct SmallJoint {
  double s = 0;              ///< mm
  double angle = 0;          ///< rad
  double velocity = 0;       ///< mm/s
  std::vector<double> step;  ///< velocity step per axis, mm/s
};

/// The duration with one kind of limit changed, all else being equal (core/plan/contour/what_if.hpp).
struct WhatIf {
  enum class What { tolerance, jerk, acceleration } what = What::tolerance;
  double factor = 1;               ///< by which it is multiplied
  std::optional<double> duration;  ///< s; none where nothing can be planned so
};

struct ContourPlan {
  std::unique_ptr<SetpointSource> setpoints;
  std::shared_ptr<const Contour> path;  ///< as driven: after blending
  /// What the setpoints are samples of; nothing where coarse and fine axes share it (CoarseFinePlan::head).
  std::shared_ptr<const PathMotion> motion;
  Verification verification;
  Bound bound;
  double duration = 0, cut_time = 0, position_time = 0;  ///< s, planned
  double path_length = 0;                                ///< mm, of the path driven: after blending
  std::size_t iterations = 0;                            ///< passes of the planner over its grid
  std::size_t pieces = 0;                                ///< pieces of the law
  std::vector<BlockReport> blocks;
  std::vector<SmallJoint> joints;
  std::vector<SlowLine> slow_lines;  ///< the 20 that take most time, in the time of the setpoints
  SectionGaps sections;              ///< between rests, against their own bounds
  std::vector<WhatIf> what_if;       ///< if asked for
  std::vector<std::string> notes;
};

/// A contour in the plane runs on a machine with more axes: those stand still, at rest in every setpoint, and neither
/// plan nor bound depend on them.
///
/// With CornerMode::blend the contour is rounded first, where that pays (core/plan/contour/rounding_choice.hpp), and
/// the verification also holds how far that strays. The rest is the pipeline (core/plan/path_plan.hpp): its cost, what
/// it throws and what it verifies; and that the motion rests where, and as long as, the contour asks for it.
///
/// Throws InvalidInput naming every fault of machine and planning (core/plan/contour/contour_faults.hpp), too.
ContourPlan plan_contour(Contour contour, const Machine& machine, const ContourPlanning& planning, Progress& progress);
/// Plans without reporting to anyone, to the end.
ContourPlan plan_contour(Contour contour, const Machine& machine, const ContourPlanning& planning = {});

}  // namespace bahnwerk
