#include "core/plan/path_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/motion/axes/length_axis.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/motion/setpoints/path_setpoints.hpp"
#include "core/plan/setpoint_count.hpp"
#include "core/verify/setpoints/setpoint_checks.hpp"
#include "core/verify/verifier.hpp"

namespace bahnwerk {
namespace {

constexpr int attempts = 4;
constexpr std::size_t max_cells = 500'000;  // that may be planned once more for the sake of the gap
constexpr double close_enough = 5e-6;       // gap to the bound at which a plan counts as converged
constexpr double largest_excess = 1e-4;     // of a limit, that counts as rounding
constexpr int max_corrections = 6;

/// On pieces so short that rounding shows, or so wide that the planner's model of them does, the verifier may find a
/// limit exceeded by a little, no more than `largest` of it: slows those sections of the law verified by as much, all
/// of them at once. False if that is not what is wrong.
bool slow_by_the_excess(const Verification& verification, double largest, TimeLaw& law) {
  for (const Check& check : verification.checks) {
    const bool scales = check.name.starts_with("velocity ") || check.name.starts_with("acceleration ") ||
                        check.name.starts_with("jerk ") || check.name.starts_with("path ");
    if (!check.passed && !(scales && check.value < check.limit * (1 + largest))) return false;
  }
  std::vector<TimeLaw::Slowing> sections;
  for (const Check& check : verification.checks)
    if (!check.passed) sections.push_back({check.at, check.value / check.limit});
  for (const TooFast& place : verification.too_fast) sections.push_back({place.at, place.factor});
  law.slow_sections(std::move(sections));
  return true;
}

class Pipeline {
 public:
  Pipeline(const PathPlanning& planning, Progress& progress)
      : planning_(planning),
        progress_(progress),
        method_(method_row(planning.method, planning.options)),
        machine_(held_limits(planning.machine, method_, planning.machine.dimension())),
        moving_(held_limits(planning.machine, method_, planning.moving->axes())),
        task_{*planning.moving, moving_, planning.feeds, planning.rests, planning.dwells} {
    for (double& feed : task_.feeds) feed = std::min(feed, limits_along().velocity);
  }

  PathPlan run() {
    if (method_.reaches_bound || !planning_.only_duration) plan_.bound = bound();
    take(law_near_the_bound());
    for (int attempt = 1;; ++attempt) {
      slow_and_verify(method_.holds_at_nodes && attempt == attempts ? unlimited : largest_excess);
      if (plan_.verification.passed || attempt == attempts) break;
      ++refinement_;
      law_ = {};
      take(solve());
    }
    plan_.pieces = law_.pieces().size();
    if (planning_.only_duration) return std::move(plan_);
    plan_.motion = std::make_shared<const PathMotion>(planning_.path, std::move(law_));
    plan_.setpoints = setpoints();
    for (Check& check : setpoint_checks({*planning_.path, machine_, plan_.motion->law(), *plan_.setpoints,
                                         planning_.blocks, at(verified), at(1), planning_.shown, planning_.lag},
                                        progress_))
      plan_.verification.add(std::move(check));
    plan_.verification.add(bound_check(plan_.bound, plan_.duration));
    plan_.bound = with_gap(plan_.bound, plan_.duration);
    return std::move(plan_);
  }

 private:
  static constexpr double bounded = 0.1, planned = 0.55, verified = 0.85;  // where the stages end
  double at(double fraction) const { return planning_.from + fraction * (planning_.to - planning_.from); }

  /// Those along the path that the method holds.
  Limits limits_along() const {
    Limits along = method_.limits_along ? planning_.options.along : Limits{};
    if (!method_.limits_jerk) along.jerk = unlimited;
    return along;
  }

  /// Under the same limits: the speed along the path is one of its feeds, the others are limits of one more axis.
  Bound bound() {
    const auto of = [&](const PathTask& task) {
      return lower_bound(task, planning_.options.corner_angle, progress_, at(0), at(bounded), &plan_.section_bounds);
    };
    const Limits along = limits_along();
    const double acceleration = largest_acceleration(along, task_.path.length());
    if (!(acceleration < unlimited)) return of(task_);
    const LengthAxisPath path(task_.path);
    Machine machine = moving_;
    machine.axes.emplace_back("path", unlimited, acceleration, along.jerk);
    return of({path, machine, task_.feeds, task_.rests, task_.dwells});
  }

  MethodResult plan() {
    const auto of = [&](const PathTask& task) {
      return method_.plan(task, planning_.options, refinement_, progress_, at(bounded), at(planned));
    };
    if (planning_.jerk_share == 1) return of(task_);
    Machine machine = moving_;
    for (AxisLimits& axis : machine.axes) axis.jerk *= planning_.jerk_share;
    return of({task_.path, machine, task_.feeds, task_.rests, task_.dwells});
  }

  TimeLaw solve() {
    MethodResult result = refinement_ == 0 && planning_.planned ? std::move(*planning_.planned) : plan();
    plan_.iterations += result.iterations;
    cells_ = result.cells;
    return std::move(result.law);
  }

  /// The proven bound tells whether the grid was fine enough, by the motion alone.
  TimeLaw law_near_the_bound() {
    TimeLaw law = solve();
    const bool reaches_bound = method_.reaches_bound && planning_.jerk_share == 1;
    for (int attempt = 1; reaches_bound && attempt < attempts; ++attempt) {
      if (with_gap({plan_.bound.duration - task_.dwell(), 0, {}}, law.duration()).gap <= close_enough ||
          cells_ > max_cells)
        break;
      ++refinement_;
      if (TimeLaw finer = solve(); finer.duration() < law.duration()) law = std::move(finer);
    }
    return law;
  }

  std::unique_ptr<SetpointSource> setpoints() const {
    if (planning_.setpoints) return planning_.setpoints(plan_.motion, plan_.cycles.count);
    return std::make_unique<PathSetpoints>(plan_.motion, planning_.machine, plan_.cycles.count);
  }

  void take(TimeLaw law) {
    law_ = with_dwells(std::move(law), task_, progress_, at(planned));
    if (!std::isfinite(law_.duration())) throw Infeasible("the planning method found no motion within the limits");
    limit_setpoints(law_.duration(), planning_.machine.cycle_time, planning_.max_setpoints);
  }

  /// In place: a law may be large.
  void slow_and_verify(double largest) {
    double slowed = 1;  // by what law_ is, against the planned one
    for (int correction = 0;; ++correction) {
      plan_.duration = law_.duration() / slowed;
      plan_.cycles = whole_cycles(plan_.duration, planning_.machine.cycle_time);
      law_.slow(plan_.cycles.factor / slowed);
      slowed = plan_.cycles.factor;
      VerifierInput input{*planning_.path, machine_, law_, planning_.feeds_to_verify, planning_.rests};
      input.corner_angle = planning_.options.corner_angle;
      input.check_jerk = method_.limits_jerk;
      input.along = limits_along();
      input.progress_from = at(planned);
      input.progress_to = at(verified);
      plan_.verification = verify_motion(input, progress_);
      if (plan_.verification.passed || correction == max_corrections ||
          !slow_by_the_excess(plan_.verification, largest, law_))
        return;
    }
  }

  const PathPlanning& planning_;
  Progress& progress_;
  MethodRow method_;
  Machine machine_, moving_;
  PathTask task_;
  int refinement_ = 0;
  std::size_t cells_ = 0;
  TimeLaw law_;
  PathPlan plan_;
};

}  // namespace

PathPlan plan_along(const PathPlanning& planning, Progress& progress) { return Pipeline(planning, progress).run(); }

}  // namespace bahnwerk
