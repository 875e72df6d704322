#include "core/contour_plan.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/acceleration_limited.hpp"
#include "core/motion/trajectory.hpp"
#include "core/verify/judge.hpp"
#include "core/verify/lower_bound.hpp"

namespace bahnwerk {

namespace {

constexpr int attempts = 4;
constexpr std::size_t most_cells = 500'000;  // that may be planned once more for the sake of the gap
constexpr double close_enough = 5e-6;        // gap to the bound at which a time-optimal plan counts as converged
constexpr double report_jump = 1e-9;         // rad; below it a tangent jump is rounding

constexpr double largest_hair = 1e-4;
constexpr int most_hairs = 6;

/// On pieces so short that rounding shows the judge may find a hair too much: slows those runs by it. False if that is
/// not what is wrong. `factor` is what the judged law was slowed by.
bool slow_by_a_hair(const Verification& verification, double factor, MotionLaw& law) {
  for (const Check& check : verification.checks) {
    const bool scales = check.name.starts_with("velocity ") || check.name.starts_with("acceleration ") ||
                        check.name.starts_with("path velocity");
    if (!check.passed && !(scales && check.value < check.limit * (1 + largest_hair))) return false;
  }
  for (const Check& check : verification.checks)
    if (!check.passed) law.slow_run(check.at / factor, check.value / check.limit);
  return true;
}

/// Times of the blocks from the law: a piece never spans two segments.
void report_blocks(const Contour& contour, const MotionLaw& law, ContourPlan& plan) {
  std::size_t i = 0;
  const auto& pieces = law.pieces();
  double t = 0;
  for (const Block& block : contour.blocks) {
    BlockReport report{block.mode, t, t, 0};
    while (i < pieces.size() && pieces[i].segment < block.last) ++i;
    t = i < pieces.size() ? pieces[i].t0 : law.duration();
    report.end_time = t;
    if (block.last > block.first) report.length = contour.path[block.last - 1].s1() - contour.path[block.first].s0();
    (block.mode == Mode::cut ? plan.cut_time : plan.position_time) += report.end_time - report.start_time;
    plan.blocks.push_back(report);
  }
}

void report_joints(const Contour& contour, const Machine& machine, const MotionLaw& law, double corner_angle,
                   ContourPlan& plan) {
  std::size_t i = 0;
  const auto& pieces = law.pieces();
  for (const Joint& joint : joints(contour.path)) {
    if (joint.angle > corner_angle || joint.angle < report_jump) continue;
    while (i < pieces.size() && pieces[i].segment < joint.next) ++i;
    if (i == pieces.size()) break;
    SmallJoint report{joint.s, joint.angle, pieces[i].v, {}};
    for (std::size_t k = 0; k < machine.dimension(); ++k) report.step.push_back(joint.step[k] * pieces[i].v);
    plan.joints.push_back(std::move(report));
  }
}

/// Half the turn per cell, a sixteenth of its model's error, a tenth of the loss.
void refine(AccelerationLimitedOptions& options) {
  options.grid.angle *= 0.5;
  options.grid.hermite *= 1.0 / 16;
  options.tolerance *= 0.1;
}

}  // namespace

ContourPlan plan_contour(Contour input, const Machine& machine, const ContourPlanning& planning, Progress& progress) {
  auto contour = std::make_shared<const Contour>(std::move(input));
  ContourPlan plan;
  plan.notes = contour->notes;
  plan.path_length = contour->path.length();

  AccelerationLimitedOptions options;
  options.keep_reserve = planning.method == PlanningMethod::braking_reserve;
  options.braking_reserve = planning.braking_reserve;
  options.corner_angle = planning.corner_angle;
  std::size_t cells = 0;
  const auto solve = [&] {
    AccelerationLimitedResult result = plan_acceleration_limited(*contour, machine, options, progress, 0.2, 0.6);
    plan.iterations += result.rounds;
    cells = result.cells;
    return std::move(result.law);
  };

  const Bound bound = lower_bound(*contour, machine, planning.corner_angle, progress, 0.0, 0.2);
  MotionLaw law = solve();
  // The proven bound tells whether the grid was fine enough.
  for (int attempt = 1; planning.method == PlanningMethod::time_optimal && attempt < attempts; ++attempt) {
    if (with_gap(bound, law.duration()).gap <= close_enough || cells > most_cells) break;
    refine(options);
    if (MotionLaw finer = solve(); finer.duration() < law.duration()) law = std::move(finer);
  }

  std::shared_ptr<const Trajectory> trajectory;
  Cycles cycles;
  for (int attempt = 1;; ++attempt) {
    for (int hair = 0;; ++hair) {
      cycles = whole_cycles(law.duration(), machine.cycle_time);
      trajectory = std::make_shared<const Trajectory>(contour, law.slowed(cycles.factor));
      JudgeInput judged{*contour, machine, trajectory->law(), planning.corner_angle};
      judged.progress_from = 0.6;
      judged.progress_to = 1.0;
      plan.verification = judge(judged, progress);
      if (plan.verification.passed || hair == most_hairs || !slow_by_a_hair(plan.verification, cycles.factor, law))
        break;
    }
    if (plan.verification.passed || attempt == attempts) break;
    refine(options);
    law = solve();
  }

  plan.pieces = law.pieces().size();
  plan.duration = law.duration();
  plan.bound = with_gap(bound, plan.duration);
  report_blocks(*contour, law, plan);
  report_joints(*contour, machine, law, planning.corner_angle, plan);
  plan.setpoints = std::make_unique<CartesianSetpoints>(trajectory, machine, cycles.count);
  return plan;
}

}  // namespace bahnwerk
