#pragma once
/// The pipeline of every kind whose result is a motion: plan, whole cycles, verification with corrections, series,
/// checks of rows, bound. A kind supplies a problem and reports the result.
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/setpoints/cycles.hpp"

namespace bahnwerk {

/// A kind's problem. The pipeline calls plan() first, then duration(), slow() and verify() as often as necessary, and
/// finally the remaining functions once each, in their order here.
class MotionProblem {
 public:
  virtual ~MotionProblem() = default;
  /// Plans a motion. Throws what the planner throws.
  virtual void plan() = 0;
  /// Called if the motion failed verification: plans it on a finer grid or by another method. Returns false, leaving
  /// the motion unchanged, if there is no alternative.
  virtual bool plan_otherwise() = 0;
  /// Returns the duration, s, of the motion as planned and corrected, before it is slowed to whole cycles.
  virtual double duration() const = 0;
  /// Slows the motion to last `factor` · duration(), factor ≥ 1, independently of earlier calls.
  virtual void slow(double factor) = 0;
  /// Verifies the slowed motion.
  virtual Verification verify() = 0;
  /// Slows what exceeds its limits by rounding only, which changes duration(). Returns false, without a change, if the
  /// verdict has another reason.
  virtual bool correct(const Verification& verdict) = 0;

  /// Returns the motion that was verified.
  virtual std::shared_ptr<const Motion> motion() = 0;
  /// Returns the setpoints of `cycles` cycles (cycles + 1 rows).
  virtual std::unique_ptr<SetpointSource> setpoints(std::size_t cycles) = 0;
  /// Checks that see every row, in one pass; the verdicts of the first `counted` ones are added to the verification.
  struct Rows {
    RowChecks checks;
    std::size_t counted = 0;
  };
  virtual Rows row_checks(const SetpointSource& setpoints, const Verification& verdict) = 0;
  /// Returns additional checks.
  virtual std::vector<Check> more_checks() { return {}; }
  /// Returns the bound of the duration; the pipeline adds its gap.
  virtual Bound bound() = 0;
};

struct PipelineOptions {
  double cycle_time = 0.001;          ///< s
  double max_setpoints = 20'000'000;  ///< largest number of setpoints; more are refused
  int max_corrections = 6;            ///< corrections of a motion before plan_otherwise()
  std::vector<std::string> cycle_time_place{"machine", "cycle_time"};  ///< place of the cycle time in the document
};

/// The plan of any motion: along a path, of a spline, of coarse and fine axes.
struct MotionPlan {
  double duration = 0;                   ///< s, as planned
  Cycles cycles;                         ///< number of cycles after slowing
  std::shared_ptr<const Motion> motion;  ///< the motion slowed to whole cycles, which is verified and sampled
  std::unique_ptr<SetpointSource> setpoints;
  Verification verification;
  RowChecks row_checks;  ///< checks that were not counted, after all rows; their verdicts are for the kind
  Bound bound;           ///< bound with its gap to the motion as planned
};

/// Returns a motion that lasts whole cycles, with its verdict: MotionPlan::duration, cycles, verification. It may fail
/// verification. Throws what the problem throws, and InvalidInput for more than max_setpoints.
MotionPlan verified_motion(MotionProblem& problem, const PipelineOptions& options);
/// Returns the plan completed with setpoints, checks of rows and bound.
MotionPlan served_motion(MotionProblem& problem, MotionPlan plan, Progress progress);

/// Returns served_motion(verified_motion()).
inline MotionPlan plan_motion(MotionProblem& problem, const PipelineOptions& options, Progress progress) {
  return served_motion(problem, verified_motion(problem, options), progress);
}

}  // namespace bahnwerk
