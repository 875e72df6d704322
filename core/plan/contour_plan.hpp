#pragma once
/// From a contour to a verified plan: law, setpoints, the verifier's verdict and the proven bound.
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/base/named.hpp"
#include "core/base/progress.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

enum class PlanningMethod { braking_reserve, time_optimal, jerk_limited };
inline constexpr Named<PlanningMethod> planning_methods[] = {{PlanningMethod::braking_reserve, "braking_reserve"},
                                                             {PlanningMethod::time_optimal, "time_optimal"},
                                                             {PlanningMethod::jerk_limited, "jerk_limited"}};
enum class CornerMode { stop, blend };

struct ContourPlanning {
  PlanningMethod method = PlanningMethod::braking_reserve;
  double braking_reserve = 0.7;                              ///< K_b [Bock (2.11)]
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad
  CornerMode corner_mode = CornerMode::stop;
  double blend_tolerance = 0;  ///< mm, of CornerMode::blend
  Limits path;                 ///< held by jerk_limited
  double max_setpoints = 20'000'000;
  bool stop_at_mode_change = false;  ///< whether the head rests where cutting and positioning meet
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

struct ContourPlan {
  std::unique_ptr<SetpointSource> setpoints;
  std::shared_ptr<const Contour> path;  ///< as driven: after blending
  Verification verification;
  Bound bound;
  double duration = 0, cut_time = 0, position_time = 0;  ///< s, planned
  double path_length = 0;                                ///< mm, of the path driven: after blending
  std::size_t iterations = 0;                            ///< passes of the planner over its grid
  std::size_t pieces = 0;                                ///< pieces of the law
  std::vector<BlockReport> blocks;
  std::vector<SmallJoint> joints;
  std::vector<std::string> notes;
};

/// A contour in the plane runs on a machine with more axes: those stand still, at rest in every setpoint, and neither
/// plan nor bound depend on them.
///
/// With CornerMode::blend the contour is rounded first, and the verification also holds how far that strays. The axes'
/// jerk limits count with jerk_limited alone. Verified are the law (core/verify/verifier.hpp), every setpoint
/// (core/verify/setpoints/setpoint_checks.hpp), and that the duration is not below its bound.
///
/// Cost: O(grid cells), about 1 µs each with verification and bound, and 0.1 to 0.3 µs per setpoint. Throws
/// InvalidInput, also for a motion of more than max_setpoints, and Stopped. A time-optimal plan that is not within
/// 5e-6 of its bound, and any plan that the verifier rejects, is planned again on a finer grid, three times at most;
/// what is returned may still be unverified: look at `verification.passed`.
ContourPlan plan_contour(Contour contour, const Machine& machine, const ContourPlanning& planning, Progress& progress);

}  // namespace bahnwerk
