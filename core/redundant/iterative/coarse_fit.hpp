#pragma once
/// One coarse axis as a spline in time that stays within a tolerance of the head: phase 1 chooses knots and fits, phase
/// 2 smooths the spline with these knots [Bock 4.2, 4.3.1].
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/redundant/iterative/knot_choice.hpp"
#include "core/redundant/iterative/spline_ends.hpp"
#include "core/redundant/iterative/spline_space.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// The samples of the head on one axis, at even times from 0 to `duration`, and the coarse axis' conditions.
struct CoarseTask {
  double duration = 0;            ///< s
  std::vector<double> positions;  ///< mm, the head's positions, ⌈duration/spacing⌉ + 1 of them
  double speed = 0;               ///< mm/s, the head's largest speed
  double tolerance = 0;           ///< mm, largest distance of the spline from the samples
  SplineBegin begin;
  std::vector<double>
      knots;      ///< s, ascending: inner knots at the start, rounded to possible places (least squares only)
  Limits limits;  ///< limits of the coarse axis; infinite jerk: no limit
  /// Returns the time of sample i, s.
  double time(std::size_t i) const {
    return duration * (static_cast<double>(i) / static_cast<double>(positions.size() - 1));
  }
};

struct CoarseFitOptions {
  CoarseApproximation approximation = CoarseApproximation::least_squares;
  CoarseSmoothing smoothing = CoarseSmoothing::quadratic_program;
  std::size_t degree = 3, multiplicity = 1;
  std::size_t afterburner = 5;      ///< N*: passes that add knots once the fit is within tolerance
  bool afterburner_evenly = false;  ///< whether these knots divide the widest gaps, as in windows [Bock 4.3.4]
  bool sampled_limits = false;      ///< whether limits hold at the samples (4.29), else for control points (4.30)
  std::size_t wide = 6;             ///< K* of KnotChoice
  double grading = 0;          ///< largest ratio of neighbouring gaps between knots, for least squares; see KnotChoice
  std::function<void()> tick;  ///< called often; may throw
};

struct CoarseFit {
  TimeSpline spline;
  std::size_t knots = 0;   ///< number of different inner knots
  double error = 0;        ///< mm, largest distance from the samples
  bool limits_met = true;  ///< whether the program of phase 2, if any, kept the limits
};

/// Returns the fit, or none if no knots bring it within tolerance. Cost: O(samples · passes); the number of passes
/// grows with the logarithm of the number of knots that an interval needs.
std::optional<CoarseFit> fit_coarse(const CoarseTask& task, const CoarseFitOptions& options);

}  // namespace bahnwerk
