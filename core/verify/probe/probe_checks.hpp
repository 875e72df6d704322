#pragma once
/// The verifier of a probe path: it checks the motion against points, tube, speed and axes' limits of the document at
/// all times, between setpoints, too. It sees polynomials in time and the times of the points, no planner.
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

struct ProbeToVerify {
  const ProbeProblem& problem;
  const Motion& motion;              ///< polynomials in time (Motion::polynomial)
  const std::vector<double>& times;  ///< s, per point of `problem.points`
};

/// Returns the checks of core/verify/motion/motion_checks.hpp (acceleration, jerk and snap per axis, continuity up to
/// jerk, rest with v = a = j = 0 at both ends) and
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
/// the largest coordinate, to which rounding of positions adds up. A piece that is no polynomial fails. O(pieces).
std::vector<Check> probe_checks(const ProbeToVerify& input, Progress progress);

}  // namespace bahnwerk
