#pragma once
/// Head motion and its split into coarse and fine axes, planned together: as fast as both axes' limits, summed, let the
/// head be, wherever the coarse axes can follow.
///
/// 1. The head is planned with the limits of both axes together (head_limits()), section by section.
/// 2. Given the head, the coarse motion of each axis is a convex problem of its own (following.hpp, chain_solver.hpp).
/// 3. Where it has no solution a certificate (certificate.hpp) shows on which stretch, and the costates show where time
///    would help most: feeds of sections there fall (slower_sections.hpp) until it has one. Only stretches around those
///    places are solved again; the whole is, at last.
/// 4. Then the energy ∫a² of each coarse axis is least at the duration found, times `stretch`: by slowing that motion,
///    or by a head that asks less of the coarse axes and takes as long, either of them evenly or most where the coarse
///    axes work hardest (slowed_by_energy.hpp), whichever is the smoothest.
///
/// No motion is shorter than the one of step 1, up to what its planner gives away, and with limited jerk up to what
/// head_limits() does; the result is not proven to be the shortest where sections were slowed. Cost: O(cells), some 5
/// to 15 µs per cell, axis and solution (tests/bench/bench_joint.cpp); sections slowed cost some ten more solutions of
/// the stretches around them.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/joint_task.hpp"

namespace bahnwerk {

class Progress;

struct JointOptions {
  double smoothness = 0;  ///< 0 … 1: how far the duration is stretched, see stretch_of()
  double stretch = 0;     ///< ≥ 1: how far the duration is stretched, in place of what `smoothness` stands for
  bool compare = false;   ///< whether to plan every stretch of `stretches` for the table
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad; larger tangent jumps are corners with a stop
  double cell = 1.0 / 24;                                    ///< longest cell, of √(stroke/coarse acceleration)
  double least_stroke = 0.02;  ///< mm; a fine axis with less stands still, unless a closed form knows better
  int max_rounds = 60;         ///< of slowing
  bool coarse_alone = false;   ///< whether all fine axes stand still
  double bound = 0;            ///< s, what any motion takes at least, as far as it is known
};

/// Cells times Newton steps that are worth it for a head that takes `duration` s: some 0.3 s, and 0.3 s per second.
/// With limited jerk a step takes three times as long.
inline double joint_work(double duration, bool jerk) { return (jerk ? 7e5 : 2e6) * (1 + duration); }

/// What a duration stretched by `stretch` ≥ 1 brings.
struct Trade {
  double stretch = 1;
  double duration = 0;         ///< s
  std::vector<double> energy;  ///< ∫a_c² dt per axis, mm²/s³
};
inline constexpr double stretches[] = {1, 1.005, 1.01, 1.02, 1.05};
/// The stretch that a smoothness stands for: linear between `stretches`, which are evenly spaced in it.
double stretch_of(double smoothness);

struct JointResult {
  std::shared_ptr<const PathMotion> head;  ///< the tool's motion
  std::shared_ptr<const Motion> coarse;
  double fastest = 0;  ///< s, what the summed limits alone let the head do
  Trade chosen;
  std::vector<Trade> trades;              ///< of every stretch, if asked for
  std::size_t cells = 0, iterations = 0;  ///< of one axis; Newton steps of all solutions of the whole
  std::size_t rounds = 0;                 ///< of slowing
  std::size_t slowed = 0;                 ///< segments whose feed was lowered
  std::size_t certified = 0;              ///< stretches proven to be too fast for the coarse axes
  bool gave_way = false;                  ///< whether nothing was found with fine axes that move
};

/// A coordinate without a fine axis, or with one whose stroke is too small for the grid of cells (`least_stroke`), is
/// the coarse axis' own (carried_motion.hpp). One straight move has a closed form (lone_move.hpp), which is taken where
/// the head cannot be as fast as the sums let it be. Where no feed helps the coarse axes move alone, the last resort:
/// as the ordinary planner plans them, at rest wherever a derivative of the path jumps that they cannot let jump.
///
/// A plan for a machine that can do less is one for a machine that can do more. So a head that was slowed is compared
/// with the coarse axes alone, and one that takes 2 % longer than `bound` with plans for seven and four tenths of the
/// strokes: the quickest stays.
///
/// Throws InvalidInput as the head's planner does, Infeasible where not even the coarse axes alone have a plan,
/// Stopped; std::invalid_argument where jerk is limited of some axes only.
JointResult plan_joint(const JointTask& task, const JointOptions& options, Progress& progress, double from = 0,
                       double to = 1);

}  // namespace bahnwerk
