#include "core/plan/probe/probe_plan.hpp"

#include <utility>

#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/plan/pipeline.hpp"
#include "core/plan/probe/probe_method.hpp"
#include "core/plan/probe/probe_setpoints.hpp"
#include "core/probe/resting_motion.hpp"
#include "core/probe/straight/stops.hpp"
#include "core/verify/probe/probe_setpoint_checks.hpp"
#include "core/verify/setpoints/motion_setpoint_checks.hpp"

namespace bahnwerk {
namespace {

// Parts of the progress at which the stages end; the bound comes last.
constexpr double planned = 0.7, verified = 0.8, read = 0.85;

/// Every method's motion keeps its limits by construction, with a margin for rounding: nothing is corrected.
class ProbeMotionProblem final : public MotionProblem {
 public:
  ProbeMotionProblem(const ProbeRequest& request, std::shared_ptr<const ProbeProblem> problem, Progress progress)
      : request_(request), problem_(std::move(problem)), progress_(progress) {}

  void plan() override {
    const Progress part = progress_.part(0, planned).named(name_of<ProbeMethod>(request_.method, probe_methods));
    planned_ = probe_motion(request_, part);
  }
  bool plan_otherwise() override { return false; }
  double duration() const override { return planned_.duration(); }
  void slow(double factor) override {
    ProgressScope scope(progress_.part(planned, planned), "whole cycles");
    slowed_ = slowed(planned_, factor, static_cast<double>(whole_cycles(duration(), cycle()).count) * cycle(), &scope);
    resting_ = std::make_shared<const RestingMotion>(slowed_.motion, problem_->points.back());
  }
  Verification verify() override {
    Verification verdict{true, {}, {}};
    verdict.add(probe_checks(to_verify(), progress_.part(planned, verified)));
    return verdict;
  }
  bool correct(const Verification&) override { return false; }

  std::shared_ptr<const Motion> motion() override { return resting_; }
  std::unique_ptr<SetpointSource> setpoints(std::size_t cycles) override {
    return std::make_unique<ProbeSetpoints>(problem_, slowed_, cycles);
  }
  Rows row_checks(const SetpointSource& setpoints, const Verification&) override {
    Rows rows{{}, 2};
    rows.checks.push_back(motion_row_check({*resting_, problem_->machine, setpoints}));
    rows.checks.push_back(probe_row_check(to_verify(), setpoints));
    return rows;
  }
  Bound bound() override {
    const Progress part = progress_.part(read, 1).named("bound");
    return probe_bound_of(request_, part);
  }

  const ProbeMotion& served() const { return slowed_; }

 private:
  double cycle() const { return problem_->machine.cycle_time; }
  ProbeToVerify to_verify() const { return {*problem_, *resting_, slowed_.times}; }

  const ProbeRequest& request_;
  std::shared_ptr<const ProbeProblem> problem_;
  Progress progress_;
  ProbeMotion planned_, slowed_;
  std::shared_ptr<const RestingMotion> resting_;
};

}  // namespace

ProbePlan plan_probe(const ProbeRequest& request, Progress progress) {
  ProbePlan plan;
  plan.problem = std::make_shared<const ProbeProblem>(request.problem);
  plan.stops = stops_duration(*plan.problem);
  ProbeMotionProblem problem(request, plan.problem, progress);
  PipelineOptions options{request.problem.machine.cycle_time, request.max_setpoints};
  options.cycle_time_place = {"cycle_time"};
  MotionPlan made = plan_motion(problem, options, progress.part(verified, read));
  plan.duration = made.duration;
  plan.cycles = made.cycles;
  plan.motion = problem.served();
  ProgressScope scope(progress.part(1, 1), "figures");
  plan.figures = probe_figures(*plan.problem, plan.motion, scope);
  plan.verification = std::move(made.verification);
  plan.bound = std::move(made.bound);
  plan.setpoints = std::move(made.setpoints);
  return plan;
}

}  // namespace bahnwerk
