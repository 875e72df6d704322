#pragma once
/// One coarse axis as a spline that stays within a tolerance of the head: phase 1, which chooses knots and fits, and
/// phase 2, which makes it smooth with those knots [Bock 4.2, 4.3.1].
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/redundant/iterative/knot_choice.hpp"
#include "core/redundant/iterative/spline_ends.hpp"
#include "core/redundant/iterative/spline_space.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// What the head does on one axis, at even times from 0 to `duration`, and what the coarse axis may do.
struct CoarseTask {
  double duration = 0;            ///< s
  std::vector<double> positions;  ///< mm, of the head: ⌈duration/spacing⌉ + 1 of them
  double speed = 0;               ///< mm/s, the head's largest
  double tolerance = 0;           ///< mm: what the fine axis may make up for at these times
  SplineBegin begin;
  std::vector<double> knots;  ///< s, ascending: near which inner knots are from the begin, for least squares
  Limits limits;              ///< of the coarse axis; jerk counts where it is finite
  double time(std::size_t i) const {
    return duration * (static_cast<double>(i) / static_cast<double>(positions.size() - 1));
  }
};

struct CoarseFitOptions {
  CoarseApproximation approximation = CoarseApproximation::least_squares;
  CoarseSmoothing smoothing = CoarseSmoothing::quadratic_program;
  std::size_t degree = 3, multiplicity = 1;
  std::size_t afterburner = 5;      ///< N*: passes with more knots, once the fit is within tolerance
  bool afterburner_evenly = false;  ///< its knots go into the widest gaps, as in windows [Bock 4.3.4]
  bool sampled_limits = false;      ///< (4.29): limits hold at the samples; else (4.30) for control points
  std::size_t wide = 6;             ///< K*
  double grading = 0;               ///< of gaps between knots, for least squares; see KnotChoice
  std::function<void()> tick;       ///< called often; may throw
};

struct CoarseFit {
  TimeSpline spline;
  std::size_t knots = 0;   ///< inner ones, each counted once
  double error = 0;        ///< mm, the largest at the samples
  bool limits_met = true;  ///< by the program of phase 2, if there was one
};

/// None where no knots bring the fit within tolerance.
/// O(samples · passes); passes grow with the logarithm of the knots that a stretch needs.
std::optional<CoarseFit> fit_coarse(const CoarseTask& task, const CoarseFitOptions& options);

}  // namespace bahnwerk
