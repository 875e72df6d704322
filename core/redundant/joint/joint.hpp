#pragma once
/// The joint planner of machines with coarse and fine axes: the head's motion and its split are planned together, so
/// that the head is as fast as the summed limits allow wherever the coarse axes can follow.
///
/// 1. The head is planned section by section with the limits of head_limits().
/// 2. Given the head, the coarse motion of each axis is a convex problem of its own (following.hpp, chain_solver.hpp).
/// 3. Where it is infeasible, a Farkas certificate (certificate.hpp) proves it on an interval, and its costates show
/// where more time helps most. Feeds of sections there fall (slower_sections.hpp) until the problem is feasible. Only
/// the intervals around such places are solved again; the whole motion is solved once at the end.
/// 4. For the duration found, multiplied by `stretch`, the energy ∫a² of each coarse axis is minimised: either the
/// motion found is slowed, or a head that needs less coarse acceleration takes its place; both evenly or mostly where
/// the coarse axes need most energy (slowed_by_energy.hpp). The candidate with the least energy is chosen.
///
/// No motion is shorter than that of step 1, except for the planner's own gap and, with limited jerk, the reduction in
/// head_limits(). Where sections were slowed the result is not proven to be optimal. Cost: O(cells), 5 to 15 µs per
/// cell, axis and solution (tests/bench/bench_joint.cpp); slowed sections cost about ten more solutions of the
/// intervals around them.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/joint_task.hpp"
#include "core/redundant/no_plan.hpp"

namespace bahnwerk {

struct JointOptions {
  double smoothness = 0;  ///< 0 … 1: how much longer the motion may be, see stretch_of()
  double stretch = 0;     ///< ≥ 1: factor of the shortest duration found; 0: stretch_of(smoothness)
  bool compare = false;   ///< whether to plan every factor in `stretches` for the table of trade-offs
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad; larger tangent jumps are corners with a stop
  double cell = 1.0 / 24;      ///< longest cell, in units of √(stroke/coarse acceleration)
  double least_stroke = 0.02;  ///< mm; a fine axis with a shorter stroke stands still, unless a closed form exists
  int max_rounds = 60;         ///< most rounds in which limits fall
  bool coarse_head = false;    ///< whether the head keeps the limits of the coarse axes alone
  double bound = 0;            ///< s, proven lower bound of the duration of any motion; 0: none is known
};

/// Returns the budget of work, in cells times Newton steps, for a head that takes `duration` s: it lasts about 0.3 s
/// plus 0.3 s per second of motion. A step of order 3, with limited jerk, takes three times as long.
inline double joint_work(double duration, std::size_t order) { return (order == 3 ? 7e5 : 2e6) * (1 + duration); }

/// One row of the table of trade-offs between duration and energy.
struct Trade {
  double stretch = 1;
  double duration = 0;         ///< s
  std::vector<double> energy;  ///< ∫a_c² dt per axis, mm²/s³
};
inline constexpr double stretches[] = {1, 1.005, 1.01, 1.02, 1.05};
/// Returns the factor of the duration for a smoothness in 0 … 1, by linear interpolation in `stretches`, which are
/// taken as evenly spaced.
double stretch_of(double smoothness);

struct JointResult {
  std::shared_ptr<const PathMotion> head;  ///< the tool's motion
  std::shared_ptr<const Motion> coarse;
  double fastest = 0;  ///< s, duration of the head under the summed limits
  Trade chosen;
  std::vector<Trade> trades;              ///< one per factor in `stretches`, if asked for
  std::size_t cells = 0, iterations = 0;  ///< cells per axis; Newton steps of all solutions of the whole motion
  std::size_t rounds = 0;                 ///< rounds in which limits fell
  std::size_t slowed = 0;                 ///< segments whose feed was lowered
  std::size_t certified = 0;              ///< intervals with a certificate that the coarse axes cannot follow
};

/// Returns the plan with the shortest duration found, times the factor that the options ask for.
///
/// A coordinate without a fine axis, or with a stroke below `least_stroke`, is carried by the coarse axis alone
/// (carried_motion.hpp). One straight move has a closed form (lone_move.hpp), used where the head cannot reach the
/// duration of the summed limits.
///
/// A plan for smaller limits or strokes also is a plan for larger ones: the table of variants in joint.cpp lists the
/// machines for which plans are made, and when. The quickest plan is returned.
///
/// Returns NoPlan if no axis has a fine one that moves, or if no variant has a plan. Throws InvalidInput as the head's
/// planner does, Stopped, and std::invalid_argument if only some axes have a limited jerk.
Expected<JointResult, NoPlan> plan_joint(const JointTask& task, const JointOptions& options, Progress progress);

}  // namespace bahnwerk
