#include "core/plan/pipeline.hpp"

#include <utility>

#include "core/plan/setpoint_count.hpp"
#include "core/verify/bound/lower_bound.hpp"

namespace bahnwerk {
namespace {

void slow_and_verify(MotionProblem& problem, const PipelineOptions& options, MotionPlan& plan) {
  limit_setpoints(problem.duration(), options.cycle_time, options.max_setpoints, options.cycle_time_place);
  for (int correction = 0;; ++correction) {
    plan.duration = problem.duration();
    plan.cycles = whole_cycles(plan.duration, options.cycle_time);
    problem.slow(plan.cycles.factor);
    plan.verification = problem.verify();
    if (plan.verification.passed || correction == options.max_corrections || !problem.correct(plan.verification))
      return;
  }
}

}  // namespace

MotionPlan verified_motion(MotionProblem& problem, const PipelineOptions& options) {
  MotionPlan plan;
  problem.plan();
  do slow_and_verify(problem, options, plan);
  while (!plan.verification.passed && problem.plan_otherwise());
  return plan;
}

MotionPlan served_motion(MotionProblem& problem, MotionPlan plan, Progress progress) {
  plan.motion = problem.motion();
  plan.setpoints = problem.setpoints(plan.cycles.count);
  MotionProblem::Rows rows = problem.row_checks(*plan.setpoints, plan.verification);
  ProgressScope stage_progress(progress, "verify setpoints");
  stage_progress.report();
  read_rows(*plan.setpoints, rows.checks, stage_progress);
  stage_progress.done(1);
  stage_progress.report();
  for (std::size_t i = 0; i < rows.counted; ++i) plan.verification.add(rows.checks[i]->checks());
  const auto counted = rows.checks.begin() + static_cast<std::ptrdiff_t>(rows.counted);
  plan.row_checks.assign(std::move_iterator(counted), std::move_iterator(rows.checks.end()));
  plan.verification.add(problem.more_checks());
  plan.bound = problem.bound();
  plan.verification.add(bound_check(plan.bound, plan.duration));
  plan.bound = with_gap(plan.bound, plan.duration);
  return plan;
}

}  // namespace bahnwerk
