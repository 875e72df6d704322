#pragma once
/// The pipeline of every kind whose result is a motion: plan, whole cycles, verification with corrections, series,
/// rows, bound. A kind brings a problem, and reports what becomes of it.
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/setpoints/cycles.hpp"

namespace bahnwerk {

class Progress;

/// What a kind brings. The pipeline calls plan() first, then duration(), slow() and verify() as often as it has to, and
/// at last the others once each, in the order in which they stand here.
class MotionProblem {
 public:
  virtual ~MotionProblem() = default;
  /// Finds a motion. Throws what the planner throws.
  virtual void plan() = 0;
  /// What was planned is not verified: plans it on a finer grid, or by another method. False: there is no other way,
  /// and the motion is left as it is.
  virtual bool plan_otherwise() = 0;
  /// s; of the motion as planned and corrected, before it is slowed to whole cycles.
  virtual double duration() const = 0;
  /// Makes the motion last `factor` · duration(), factor ≥ 1. What it was slowed by before does not count.
  virtual void slow(double factor) = 0;
  virtual Verification verify() = 0;
  /// Slows what exceeds its limits by so little that it is rounding, which changes duration(). False: something else is
  /// wrong, and nothing is changed.
  virtual bool correct(const Verification& verdict) = 0;

  /// The motion that was verified.
  virtual std::shared_ptr<const Motion> motion() = 0;
  virtual std::unique_ptr<SetpointSource> setpoints(std::size_t cycles) = 0;
  /// All of them see every row, in one pass; the verdicts of the first `counted` are added to the verification.
  struct Rows {
    RowChecks checks;
    std::size_t counted = 0;
  };
  virtual Rows row_checks(const SetpointSource& setpoints, const Verification& verdict) = 0;
  /// What is checked besides.
  virtual std::vector<Check> more_checks() { return {}; }
  /// On the duration; its gap is the pipeline's to tell.
  virtual Bound bound() = 0;
};

struct PipelineOptions {
  double cycle_time = 0.001;          ///< s
  double max_setpoints = 20'000'000;  ///< more are refused
  int max_corrections = 6;            ///< of a motion, before it is planned otherwise
  double rows_from = 0, rows_to = 1;  ///< the share of the job's progress that reading the rows takes
  std::vector<std::string> cycle_time_place{"machine", "cycle_time"};  ///< where the document has it
};

/// The plan of any motion: along a path, of a spline, of coarse and fine axes.
struct MotionPlan {
  double duration = 0;                   ///< s, as planned
  Cycles cycles;                         ///< that it was slowed to
  std::shared_ptr<const Motion> motion;  ///< slowed to whole cycles: what is verified and sampled
  std::unique_ptr<SetpointSource> setpoints;
  Verification verification;
  RowChecks row_checks;  ///< those that were not counted, which have seen all rows: their verdicts are for the kind
  Bound bound;           ///< with its gap to the motion as planned
};

/// Returns a motion that lasts whole cycles, with its verdict: MotionPlan::duration, cycles, verification. It may fail
/// verification. Throws what the problem throws, and InvalidInput for more than max_setpoints.
MotionPlan verified_motion(MotionProblem& problem, const PipelineOptions& options);
/// Adds setpoints, what their rows are checked for, and the bound.
MotionPlan served_motion(MotionProblem& problem, MotionPlan plan, const PipelineOptions& options, Progress& progress);

inline MotionPlan plan_motion(MotionProblem& problem, const PipelineOptions& options, Progress& progress) {
  return served_motion(problem, verified_motion(problem, options), options, progress);
}

}  // namespace bahnwerk
