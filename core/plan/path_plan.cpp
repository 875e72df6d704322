#include "core/plan/path_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/motion/axes/length_axis.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/motion/setpoints/path_setpoints.hpp"
#include "core/plan/pipeline.hpp"
#include "core/verify/law/verifier.hpp"
#include "core/verify/setpoints/setpoint_checks.hpp"

namespace bahnwerk {
namespace {

constexpr int attempts = 4;                 // number of plans on finer and finer grids
constexpr std::size_t max_cells = 500'000;  // largest grid that is planned once more for the sake of the gap
constexpr double close_enough = 5e-6;       // gap to the bound at which a plan counts as converged
// If a finer grid costs little, the plan has to be closer to its bound, so that both directions of a contour take
// equally long to 1e-6; refinement ends when the last grid gained less than this.
constexpr double closer = 5e-7, worthwhile = 2e-7;
constexpr std::size_t few_cells = 20'000;
constexpr double largest_excess = 1e-4;  // relative excess over a limit that counts as rounding

/// Slows the sections of the verified law in which limits are exceeded by little, at most relatively by `largest`, all
/// at once. Such excess occurs in pieces so short that rounding shows, or so wide that the planner's model of them is
/// inexact. Returns false if the verdict has another reason.
bool slow_by_the_excess(const Verification& verification, double largest, TimeLaw& law) {
  for (const Check& check : verification.checks) {
    if (!check.passed && !(falls_with_speed(check) && check.value < check.limit * (1 + largest))) return false;
  }
  std::vector<TimeLaw::Slowing> sections;
  for (const Check& check : verification.checks)
    if (!check.passed) sections.push_back({check.at, check.value / check.limit});
  for (const TooFast& place : verification.too_fast) sections.push_back({place.at, place.factor});
  law.slow_sections(std::move(sections));
  return true;
}

class PathProblem final : public MotionProblem {
 public:
  PathProblem(const PathPlanning& planning, Progress progress, std::optional<MethodResult> first)
      : planning_(planning),
        progress_(progress),
        first_(std::move(first)),
        method_(planning.method),
        moving_(planning.machine),
        task_{*planning.moving, moving_, planning.feeds, planning.rests, planning.dwells} {
    moving_.axes.resize(planning.moving->axes());
    for (double& feed : task_.feeds) feed = std::min(feed, limits_along().velocity);
  }

  static constexpr double bounded = 0.1, planned = 0.55,
                          verified = 0.85;  // parts of the progress at which the stages end

  void plan() override {
    if (method_.refinement == Refinement::to_bound || !planning_.only_duration) bound_ = find_bound();
    take(refined_law());
  }
  bool plan_otherwise() override {
    if (attempt_ == attempts) return false;
    ++attempt_, ++refinement_;
    law_ = {};
    take(solve());
    return true;
  }
  double duration() const override { return law_.duration() / slowed_; }
  /// Slows in place, because a law may be large.
  void slow(double factor) override {
    law_.slow(factor / slowed_);
    slowed_ = factor;
  }
  Verification verify() override {
    VerifierInput input{*planning_.path, planning_.machine, law_, planning_.feeds_to_verify, planning_.rests};
    input.corner_angle = planning_.options.corner_angle;
    input.order = method_.order;
    input.along = limits_along();
    return verify_motion(input, progress_.part(planned, verified));
  }
  bool correct(const Verification& verdict) override {
    return slow_by_the_excess(verdict, method_.holds_at_nodes && attempt_ == attempts ? unlimited : largest_excess,
                              law_);
  }

  std::shared_ptr<const Motion> motion() override {
    pieces_ = law_.pieces().size();
    return motion_ = std::make_shared<const PathMotion>(planning_.path, std::move(law_));
  }
  std::unique_ptr<SetpointSource> setpoints(std::size_t cycles) override {
    if (planning_.setpoints) return planning_.setpoints(motion_, cycles);
    return std::make_unique<PathSetpoints>(motion_, planning_.machine, cycles);
  }
  Rows row_checks(const SetpointSource& setpoints, const Verification& verdict) override {
    Rows rows{{}, 1};
    rows.checks.push_back(path_row_check({*planning_.path, planning_.machine, motion_->law(), setpoints,
                                          planning_.blocks, planning_.shown, planning_.lag}));
    if (planning_.row_checks)
      for (auto& check : planning_.row_checks(*motion_, setpoints, verdict)) rows.checks.push_back(std::move(check));
    return rows;
  }
  Bound bound() override { return bound_; }

  /// Limits that only motions along a path have.
  PathPlan report(MotionPlan found) {
    PathPlan plan;
    plan.duration = found.duration, plan.cycles = found.cycles, plan.bound = std::move(found.bound);
    plan.setpoints = std::move(found.setpoints);
    plan.verification = std::move(found.verification);
    plan.row_checks = std::move(found.row_checks);
    plan.pieces = motion_ ? pieces_ : law_.pieces().size();
    plan.motion = std::move(motion_);
    plan.section_bounds = std::move(section_bounds_);
    plan.iterations = iterations_;
    return plan;
  }

 private:
  /// Limits along the path that the method keeps.
  Limits limits_along() const {
    Limits along = method_.limits_along ? planning_.options.along : Limits{};
    if (method_.order == 2) along.jerk = unlimited;
    return along;
  }

  /// The bound applies to the same limits: the path's speed limit is one of its feeds, the other path limits those of
  /// one more axis.
  Bound find_bound() {
    const auto of = [&](const PathTask& task) {
      return lower_bound(task, planning_.options.corner_angle, progress_.part(0, bounded), &section_bounds_);
    };
    const Limits along = limits_along();
    const double acceleration = largest_acceleration(along, task_.path.length());
    if (!(acceleration < unlimited)) return of(task_);
    const LengthAxisPath path(task_.path);
    Machine machine = moving_;
    machine.axes.emplace_back("path", unlimited, acceleration, along.jerk);
    return of({path, machine, task_.feeds, task_.rests, task_.dwells});
  }

  MethodResult find_law() {
    const auto of = [&](const PathTask& task) {
      return method_.plan(task, planning_.options, refinement_, progress_.part(bounded, planned));
    };
    if (planning_.jerk_share == 1) return of(task_);
    Machine machine = moving_;
    for (AxisLimits& axis : machine.axes) axis.jerk *= planning_.jerk_share;
    return of({task_.path, machine, task_.feeds, task_.rests, task_.dwells});
  }

  TimeLaw solve() {
    MethodResult result = first_ ? *std::exchange(first_, std::nullopt) : find_law();
    iterations_ += result.iterations;
    cells_ = result.cells;
    return std::move(result.law);
  }

  /// Plans on finer grids while that is worthwhile, as the method's row tells.
  TimeLaw refined_law() {
    TimeLaw law = solve();
    const bool reaches_bound = method_.refinement == Refinement::to_bound;
    if (method_.refinement == Refinement::none || (reaches_bound && planning_.jerk_share != 1)) return law;
    bool gained = true;
    for (int attempt = 1; attempt < attempts; ++attempt) {
      const double gap =
          reaches_bound ? with_gap({bound_.value - task_.dwell(), 0, {}}, law.duration()).gap : close_enough;
      const bool may_gain = gained && cells_ <= few_cells;
      if (gap <= closer || cells_ > max_cells || (gap <= close_enough && !may_gain)) break;
      ++refinement_;
      TimeLaw finer = solve();
      const double gain = 1 - finer.duration() / law.duration();
      gained = reaches_bound ? gain > worthwhile : std::abs(gain) > worthwhile;
      if (gain > 0 || (!reaches_bound && std::isfinite(finer.duration()))) law = std::move(finer);
    }
    return law;
  }

  void take(TimeLaw law) {
    law_ = with_dwells(std::move(law), task_, progress_.part(planned, planned));
    slowed_ = 1;
    if (!std::isfinite(law_.duration())) throw Infeasible("the planning method found no motion within the limits");
  }

  const PathPlanning& planning_;
  Progress progress_;
  std::optional<MethodResult> first_;
  const MethodRow& method_;
  Machine moving_;
  PathTask task_;
  int attempt_ = 1, refinement_ = 0;
  std::size_t cells_ = 0, iterations_ = 0, pieces_ = 0;
  TimeLaw law_;
  double slowed_ = 1;  ///< factor by which law_ is slower than the planned one
  std::shared_ptr<const PathMotion> motion_;
  Bound bound_;
  std::vector<SectionBound> section_bounds_;
};

}  // namespace

PathPlan plan_along(const PathPlanning& planning, Progress progress, std::optional<MethodResult> first) {
  PathProblem problem(planning, progress, std::move(first));
  PipelineOptions options{planning.machine.cycle_time, planning.max_setpoints};
  MotionPlan plan = verified_motion(problem, options);
  if (!planning.only_duration) plan = served_motion(problem, std::move(plan), progress.part(PathProblem::verified, 1));
  return problem.report(std::move(plan));
}

}  // namespace bahnwerk
