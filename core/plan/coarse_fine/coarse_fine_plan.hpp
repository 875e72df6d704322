#pragma once
/// The verified plan of a contour on a machine with coarse and fine axes.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/plan/coarse_fine/rms.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

struct CoarseFinePlan {
  ContourPlan contour;  ///< the parts that all plans of contours have; its setpoints are CoarseFineSetpoints
  std::shared_ptr<const PathMotion> head;        ///< the head's motion as sampled
  std::shared_ptr<const Motion> coarse;          ///< the coarse axes' motion as sampled, with every axis of the machine
  double fastest = 0;                            ///< s, duration of the head that was planned first
  std::vector<double> energy;                    ///< ∫a_c² dt per axis, mm²/s³, as planned
  std::vector<double> peak_coarse_acceleration;  ///< per axis, mm/s², as sampled and verified
  RmsAccelerations rms;                          ///< root mean square accelerations of the sampled motion
  std::vector<RedundancyTrade> trades;
  std::vector<RedundancyIteration> passes;
  struct Slowed {
    std::size_t source =
        0;              ///< source of the path's segment: a program's line, else the segment's number in the document
    double length = 0;  ///< mm
    double feed = 0;    ///< mm/s, reduced feed; infinite if only accelerations were reduced
  };
  std::vector<Slowed> slowed;  ///< slowed segments, if the method lists them
  std::size_t slowed_count = 0;
  std::vector<SectionGap> slow_sections;  ///< the 100 sections between rests that exceed their own bounds most
  std::size_t certified = 0;
  std::vector<GaveWay> gave_way;
  bool coarse_jerk_limited = false;
  std::vector<RedundancyLag> lags;
};

/// Return the coarse axes with `c`, and the fine axes with `f`, behind their names, and their limits. A fine axis'
/// range is its stroke; without a fine axis it is 1e-9 mm, the rounding, and other limits are infinite.
std::vector<AxisLimits> coarse_limits(const CoarseFineMachine& machine);
std::vector<AxisLimits> fine_limits(const CoarseFineMachine& machine);

/// Returns the plan. The contour is rounded as by plan_contour(), for a head with head_limits(); the row of
/// `options.method` plans head and coarse axes; both are slowed to whole cycles. The verification covers the head as in
/// plan_along() with the summed limits, coarse and fine axes between samples
/// (core/verify/redundant/coarse_fine_checks.hpp), all their setpoints, and that the duration is not below the bound of
/// the head under the summed limits, which holds for any split. A limit exceeded by rounding (relatively by 1e-4) slows
/// the whole motion accordingly. Of `planning` only corners, mode changes and the number of setpoints apply; the head's
/// law is always the shortest one, with limited jerk if the machine limits it. The list in
/// core/redundant/methods/candidates.cpp says what is planned, and what takes the place of a plan that fails
/// verification or of a method without a plan; `gave_way` is its record.
///
/// Cost: that of the method and 2 to 8 µs per cell of its coarse motion for verification. Throws what rounding and
/// methods throw, and Infeasible if no candidate has a plan.
CoarseFinePlan plan_coarse_fine(Contour contour, const CoarseFineMachine& machine, const ContourPlanning& planning,
                                const RedundancyOptions& options, Progress progress);

}  // namespace bahnwerk
