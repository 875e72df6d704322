#pragma once
/// Figures of a probe motion for its user: length, mean speed, ripple of the speed, deviation from the edges.
#include "core/base/progress_scope.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

struct ProbeFigures {
  double path_length = 0;    ///< ∫ |v| dt, mm
  double mean_speed = 0;     ///< path_length / duration, mm/s
  double max_deviation = 0;  ///< largest distance from the edge that is being passed, mm, enclosed to 1e-6 of it
  /// (max − min)/mean of |v| between the second point and the last but one, dimensionless; 0 where these are one point.
  /// The largest |v| is enclosed to 1e-9, the least one is found by subdivision to 1e-9 of the largest.
  double speed_ripple = 0;
};

/// Computes the figures; O(pieces), some µs each. Throws what progress throws.
ProbeFigures probe_figures(const ProbeProblem& problem, const ProbeMotion& motion, ProgressScope& progress);

}  // namespace bahnwerk
