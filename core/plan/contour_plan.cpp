#include "core/plan/contour_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/base/errors.hpp"
#include "core/contour/blend.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/motion/law/block_times.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/motion/law/trajectory.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "core/verify/geometry/tube.hpp"
#include "core/verify/law/rest_check.hpp"
#include "core/verify/setpoints/setpoint_checks.hpp"
#include "core/verify/verifier.hpp"

namespace bahnwerk {

namespace {

constexpr int attempts = 4;
constexpr std::size_t max_cells = 500'000;  // that may be planned once more for the sake of the gap
constexpr double close_enough = 5e-6;       // gap to the bound at which a time-optimal plan counts as converged
constexpr double report_jump = 1e-9;        // rad; below it a tangent jump is rounding

constexpr double largest_excess = 1e-4;  // of a limit
constexpr int max_corrections = 6;

/// On pieces so short that rounding shows the verifier may find a limit exceeded by a little: slows those sections by
/// as much. False if that is not what is wrong. `factor` is what the verified law was slowed by.
bool slow_by_the_excess(const Verification& verification, double factor, TimeLaw& law) {
  for (const Check& check : verification.checks) {
    const bool scales = check.name.starts_with("velocity ") || check.name.starts_with("acceleration ") ||
                        check.name.starts_with("jerk ") || check.name.starts_with("path ");
    if (!check.passed && !(scales && check.value < check.limit * (1 + largest_excess))) return false;
  }
  for (const Check& check : verification.checks)
    if (!check.passed) law.slow_run(check.at / factor, check.value / check.limit);
  return true;
}

/// Times of the blocks in the motion that is sampled; the sums per mode in the planned one, which is `factor` quicker.
void report_blocks(const Contour& contour, const TimeLaw& sampled, double factor, ContourPlan& plan) {
  const std::vector<BlockTime> times = block_times(contour, sampled);
  for (std::size_t b = 0; b < times.size(); ++b) {
    const Block& block = contour.blocks[b];
    BlockReport report{block.mode, times[b].begin, times[b].end, 0};
    if (block.last > block.first) report.length = contour.path[block.last - 1].s1() - contour.path[block.first].s0();
    (block.mode == Mode::cut ? plan.cut_time : plan.position_time) += (report.end_time - report.start_time) / factor;
    plan.blocks.push_back(report);
  }
}

void report_joints(const Contour& contour, const Machine& machine, const TimeLaw& law, double corner_angle,
                   ContourPlan& plan, Progress& progress) {
  std::size_t i = 0;
  const auto& pieces = law.pieces();
  const std::vector<bool> rest = contour.rest_places();
  for (const Joint& joint : joints(contour.path, [&] { progress.report("verify", 1); })) {
    if (joint.angle > corner_angle || joint.angle < report_jump) continue;
    while (i < pieces.size() && pieces[i].segment < joint.next) ++i;
    if (rest[joint.next]) continue;
    if (i == pieces.size()) break;
    SmallJoint report{joint.s, joint.angle, pieces[i].v, {}};
    for (std::size_t k = 0; k < machine.dimension(); ++k) report.step.push_back(joint.step[k] * pieces[i].v);
    plan.joints.push_back(std::move(report));
  }
}

/// What the methods have in common: a law for the contour, on request by a finer grid.
class Solver {
 public:
  Solver(const Contour& contour, const Machine& machine, const ContourPlanning& planning)
      : contour_(contour), machine_(machine), jerk_limited_(planning.method == PlanningMethod::jerk_limited) {
    smooth_.corner_angle = quick_.corner_angle = planning.corner_angle;
    quick_.keep_reserve = planning.method == PlanningMethod::braking_reserve;
    quick_.braking_reserve = planning.braking_reserve;
    smooth_.path = planning.path;
  }
  TimeLaw solve(Progress& progress, double from, double to) {
    if (jerk_limited_) {
      JerkLimitedResult result = plan_jerk_limited(contour_, machine_, smooth_, progress, from, to);
      iterations_ += result.iterations;
      cells_ = result.cells;
      return std::move(result.law);
    }
    AccelerationLimitedResult result = plan_acceleration_limited(contour_, machine_, quick_, progress, from, to);
    iterations_ += result.rounds;
    cells_ = result.cells;
    return std::move(result.law);
  }
  /// Half the turn per cell, a sixteenth of its model's error, a tenth of the loss.
  void refine() {
    quick_.grid.angle *= 0.5;
    quick_.grid.hermite *= 1.0 / 16;
    quick_.tolerance *= 0.1;
    smooth_.angle *= 0.5;
    smooth_.tolerance *= 0.1;
  }
  std::size_t iterations() const { return iterations_; }
  std::size_t cells() const { return cells_; }

 private:
  const Contour& contour_;
  const Machine& machine_;
  bool jerk_limited_;
  AccelerationLimitedOptions quick_;
  JerkLimitedOptions smooth_;
  std::size_t iterations_ = 0, cells_ = 0;
};

void check_count(const TimeLaw& law, const Machine& machine, const ContourPlanning& planning) {
  const double count = std::ceil(law.duration() / machine.cycle_time) + 1;
  if (!(count > planning.max_setpoints)) return;
  char text[120];
  std::snprintf(text, sizeof text, "the motion has %.0f setpoints, at most %.0f are allowed", count,
                planning.max_setpoints);
  throw InvalidInput({{{"machine", "cycle_time"}, text}});
}

Machine held_limits(const Machine& machine, const ContourPlanning& planning) {
  Machine held = machine;
  if (planning.method != PlanningMethod::jerk_limited)
    for (AxisLimits& axis : held.axes) axis.jerk = unlimited;
  return held;
}

/// The axes that a contour moves: in the plane x and y. The others stand still and limit nothing.
Machine moving_axes(Machine machine, const Contour& contour) {
  if (machine.axes.size() > contour.dimension) machine.axes.resize(contour.dimension);
  return machine;
}

}  // namespace

ContourPlan plan_contour(Contour input, const Machine& given_machine, const ContourPlanning& planning,
                         Progress& progress) {
  const Machine machine = held_limits(given_machine, planning), moving = moving_axes(machine, input);
  if (planning.stop_at_mode_change) stop_at_mode_changes(input);
  const auto given = std::make_shared<const Contour>(std::move(input));
  const bool blended = planning.corner_mode == CornerMode::blend;
  const double read = blended ? 0.1 : 0.0, bounded = 0.2, planned = 0.6, verified = 0.85, served = blended ? 0.95 : 1.0;
  auto contour = given;
  if (blended)
    contour = std::make_shared<const Contour>(
        blend(*given, {planning.blend_tolerance, planning.corner_angle}, moving, progress, 0.0, read));
  ContourPlan plan;
  plan.notes = contour->notes;
  for (std::size_t k = moving.dimension(); k < machine.dimension(); ++k) {
    char text[120];
    std::snprintf(text, sizeof text, "axis %s stands still at %.6g mm: the contour is planar",
                  machine.axes[k].name.c_str(), contour->height);
    plan.notes.emplace_back(text);
  }
  plan.path_length = contour->path.length();

  Solver solver(*contour, moving, planning);
  const Bound bound = lower_bound(*contour, moving, planning.corner_angle, progress, read, bounded);
  TimeLaw law = solver.solve(progress, bounded, planned);
  const double dwell = contour->dwell();
  // The proven bound tells whether the grid was fine enough, by the motion alone.
  for (int attempt = 1; planning.method == PlanningMethod::time_optimal && attempt < attempts; ++attempt) {
    if (with_gap({bound.duration - dwell, 0, {}}, law.duration()).gap <= close_enough || solver.cells() > max_cells)
      break;
    solver.refine();
    if (TimeLaw finer = solver.solve(progress, bounded, planned); finer.duration() < law.duration())
      law = std::move(finer);
  }

  law = with_dwells(std::move(law), *contour, progress, planned);
  check_count(law, machine, planning);
  std::shared_ptr<const Trajectory> trajectory;
  Cycles cycles;
  for (int attempt = 1;; ++attempt) {
    for (int correction = 0;; ++correction) {
      cycles = whole_cycles(law.duration(), machine.cycle_time);
      trajectory = std::make_shared<const Trajectory>(contour, law.slowed(cycles.factor));
      ContourVerifierInput verdict{*contour, machine, trajectory->law(), planning.corner_angle};
      if (blended) verdict.given = given.get();
      verdict.progress_from = planned;
      verdict.progress_to = verified;
      if (planning.method == PlanningMethod::jerk_limited) {
        verdict.check_jerk = true;
        verdict.path = planning.path;
      }
      plan.verification = verify_motion(verdict, progress);
      if (plan.verification.passed || correction == max_corrections ||
          !slow_by_the_excess(plan.verification, cycles.factor, law))
        break;
    }
    if (plan.verification.passed || attempt == attempts) break;
    solver.refine();
    law = with_dwells(solver.solve(progress, bounded, planned), *contour, progress, planned);
    check_count(law, machine, planning);
  }
  const auto also = [&plan](Check check) {
    plan.verification.passed = plan.verification.passed && check.passed;
    plan.verification.checks.push_back(std::move(check));
  };
  auto setpoints = std::make_unique<CartesianSetpoints>(trajectory, machine, cycles.count);
  for (Check& check : setpoint_checks({*contour, machine, trajectory->law(), *setpoints, verified, served}, progress))
    also(std::move(check));
  also(bound_check(bound, law.duration()));
  if (!given->rests.empty()) also(rest_check(*given, *contour, trajectory->law(), progress, served));
  if (blended)
    for (Check& check : tube_checks(*given, *contour, planning.blend_tolerance, progress, served, 1.0))
      also(std::move(check));

  plan.iterations = solver.iterations();
  plan.pieces = law.pieces().size();
  plan.duration = law.duration();
  plan.bound = with_gap(bound, plan.duration);
  report_blocks(*contour, trajectory->law(), cycles.factor, plan);
  report_joints(*contour, moving, law, planning.corner_angle, plan, progress);
  plan.setpoints = std::move(setpoints);
  plan.path = contour;
  return plan;
}

}  // namespace bahnwerk
