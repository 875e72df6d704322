#include "core/contour_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/motion/acceleration_limited.hpp"
#include "core/motion/trajectory.hpp"
#include "core/verify/judge.hpp"
#include "core/verify/lower_bound.hpp"

namespace bahnwerk {

namespace {

constexpr int attempts = 3;
constexpr double report_jump = 1e-9;  // rad; below it a tangent jump is rounding

constexpr double largest_hair = 1e-4;

/// By how much the worst velocity or acceleration exceeds its limit; infinity when something else failed.
double excess(const Verification& verification) {
  double over = 0;
  for (const Check& check : verification.checks) {
    if (check.passed) continue;
    const bool scales = check.name.starts_with("velocity ") || check.name.starts_with("acceleration ") ||
                        check.name.starts_with("path velocity");
    over = std::max(over, scales ? check.value / check.limit - 1 : std::numeric_limits<double>::infinity());
  }
  return over;
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
  std::shared_ptr<const Trajectory> trajectory;
  Cycles cycles;
  for (int attempt = 1; attempt <= attempts; ++attempt) {
    AccelerationLimitedResult result = plan_acceleration_limited(*contour, machine, options, progress, 0.0, 0.4);
    plan.iterations += result.rounds;
    plan.pieces = result.law.pieces().size();
    for (bool slowed = false;; slowed = true) {
      cycles = whole_cycles(result.law.duration(), machine.cycle_time);
      trajectory = std::make_shared<const Trajectory>(contour, result.law.slowed(cycles.factor));
      JudgeInput judged{*contour, machine, trajectory->law(), planning.corner_angle};
      judged.progress_from = 0.4;
      judged.progress_to = 0.7;
      plan.verification = judge(judged, progress);
      // On pieces so short that rounding shows the judge may find a hair too much: slow down by it, once.
      const double over = plan.verification.passed ? 0 : excess(plan.verification);
      if (!(over > 0 && over < largest_hair) || slowed) break;
      result.law = result.law.slowed(1 + over);
    }
    plan.duration = result.law.duration();
    plan.blocks.clear();
    plan.joints.clear();
    plan.cut_time = plan.position_time = 0;
    report_blocks(*contour, result.law, plan);
    report_joints(*contour, machine, result.law, planning.corner_angle, plan);
    if (plan.verification.passed) break;
    options.grid.angle *= 0.5;
    options.grid.hermite *= 1.0 / 16;
  }
  plan.bound = with_gap(lower_bound(*contour, machine, planning.corner_angle, progress, 0.7, 1.0), plan.duration);
  plan.setpoints = std::make_unique<CartesianSetpoints>(trajectory, machine, cycles.count);
  return plan;
}

}  // namespace bahnwerk
