#pragma once
/// The verifier of a probe path: the motion against the points, the tube, the speed and the axes' limits of the
/// document, everywhere between samples. It sees polynomials of time and the times of the points, no planner.
#include <vector>

#include "core/base/verification.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

class Progress;

struct ProbeToVerify {
  const ProbeProblem& problem;
  const Motion& motion;              ///< polynomials in time (Motion::polynomial)
  const std::vector<double>& times;  ///< s, per point of `problem.points`
  double progress_from = 0, progress_to = 1;
};

/// Checks of core/verify/motion/motion_checks.hpp: acceleration, jerk and snap per axis, continuity up to jerk, rest
/// (v = a = j = 0) at both ends; and
///
/// `speed`           mm/s  the largest |v|
/// `deviation`       mm    on [t_i, t_(i+1)] the largest distance from the segment P_i P_(i+1) itself
/// `points`          mm    the largest |x(t_i) − P_i| over all points of the document; those that count as one have
///                         one time. Infinite where the times do not ascend from 0 to the end, or points were taken for
///                         one that are not
/// `start position`, `end position`  mm  against 1e-9 mm
///
/// Peaks are enclosures: Bernstein coefficients of every piece, cut where edges change, halved until they decide to
/// 1e-9. Speed and points hold when value ≤ limit · (1 + 1e-9), deviations when value ≤ limit · (1 + 1e-9) + 1e-12 of
/// the largest coordinate, which is what rounding of positions adds up to. What is no polynomial fails. O(pieces).
std::vector<Check> probe_checks(const ProbeToVerify& input, Progress& progress);

}  // namespace bahnwerk
