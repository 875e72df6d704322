#pragma once
/// From a contour and a machine with coarse and fine axes to a verified plan.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/contour/contour.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/plan/coarse_fine/rms.hpp"
#include "core/plan/contour_plan.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

class Progress;

struct CoarseFinePlan {
  ContourPlan contour;  ///< what every plan of a contour tells; its setpoints are CoarseFineSetpoints
  std::shared_ptr<const PathMotion> head;        ///< as sampled
  std::shared_ptr<const Motion> coarse;          ///< as sampled, every axis of the machine
  double fastest = 0;                            ///< s, what the first head's motion takes
  std::vector<double> energy;                    ///< ∫a_c² dt per axis, mm²/s³, as planned
  std::vector<double> peak_coarse_acceleration;  ///< per axis, mm/s², as sampled and verified
  RmsAccelerations rms;                          ///< as sampled
  std::vector<RedundancyTrade> trades;
  std::vector<RedundancyIteration> passes;
  struct Slowed {
    std::size_t source = 0;  ///< of the path's segment: a program's line, else the segment's number in the document
    double length = 0;       ///< mm
    double feed = 0;         ///< mm/s; infinite where only its accelerations were lowered
  };
  std::vector<Slowed> slowed;  ///< as far as the method tells
  std::size_t slowed_count = 0;
  std::vector<SectionGap> slow_sections;  ///< between rests, the 100 that lose most time against their own bounds
  std::size_t certified = 0;
  std::size_t fallbacks = 0;
  bool coarse_jerk_limited = false;
  std::vector<RedundancyLag> lags;
};

/// Axes of the machine with `c` and `f` behind their names, and what they may do. A fine axis' range is its stroke;
/// where there is none it is 1e-9 mm, what rounding leaves, and nothing else is limited.
std::vector<AxisLimits> coarse_limits(const CoarseFineMachine& machine);
std::vector<AxisLimits> fine_limits(const CoarseFineMachine& machine);

/// The contour is rounded as plan_contour() does, for a head with head_limits(); the row of `options.method` plans head
/// and coarse axes; both are slowed to whole cycles. Verified are the head as in plan_path(), with the sums of the
/// limits, coarse and fine axes between samples (core/verify/redundant/coarse_fine_checks.hpp), every setpoint of all
/// of them, and that the duration is not below the bound, which holds for any split: that of the head by itself with
/// the sums. A limit exceeded by so little that it is rounding (1e-4 of it) slows everything by as much. Of `planning`
/// corners, mode changes and the number of setpoints count; the head's law is the shortest one, with limited jerk where
/// the machine limits it. A plan that does not pass gives way to the same one without its new timing, then to the
/// joint planner's, and at last to that of the coarse axes alone, with fine axes that stand still; so does a method
/// that finds none. That is counted in `fallbacks`, with a note.
///
/// Cost: that of the method and, for verification, 2 to 8 µs per cell of its coarse motion. Throws what rounding and
/// method throw.
CoarseFinePlan plan_coarse_fine(Contour contour, const CoarseFineMachine& machine, const ContourPlanning& planning,
                                const RedundancyOptions& options, Progress& progress);

}  // namespace bahnwerk
