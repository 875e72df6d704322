#pragma once
/// Figures of a probe motion that a user asks for: length, speed, how even it is, how far it is from the edges.
#include "core/base/progress_scope.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

struct ProbeFigures {
  double path_length = 0;    ///< ∫ |v| dt, mm
  double mean_speed = 0;     ///< of the whole motion, mm/s
  double max_deviation = 0;  ///< from the edge that is being passed, mm, an enclosure to 1e-6 of it
  /// (max − min)/mean of |v| between the second point and the last but one, 1; 0 where nothing is between them. The
  /// largest |v| is an enclosure, the least is found by subdivision, to 1e-9 of the largest.
  double speed_ripple = 0;
};

/// O(pieces), some µs each. Throws what progress throws.
ProbeFigures probe_figures(const ProbeProblem& problem, const ProbeMotion& motion, ProgressScope& progress);

}  // namespace bahnwerk
