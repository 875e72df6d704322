#include "core/plan/contour_plan.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "core/contour/blend.hpp"
#include "core/motion/law/block_times.hpp"
#include "core/motion/setpoints/contour_setpoints.hpp"
#include "core/plan/path_plan.hpp"
#include "core/verify/geometry/tube.hpp"
#include "core/verify/law/rest_check.hpp"
#include "core/verify/verifier.hpp"

namespace bahnwerk {

namespace {

constexpr std::size_t slow_lines_listed = 20;
constexpr double report_jump = 1e-9;  // rad; below it a tangent jump is rounding

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

/// Speeds as planned: `factor` times those that are sampled.
void report_joints(const Contour& contour, std::size_t axes, const TimeLaw& sampled, double factor, double corner_angle,
                   ContourPlan& plan, Progress& progress) {
  std::size_t i = 0;
  const auto& pieces = sampled.pieces();
  const std::vector<bool> rest = contour.rest_places();
  ProgressScope scope(progress, "verify", 1, 1);
  for (const Joint& joint : joints(contour.path, &scope)) {
    if (joint.angle > corner_angle || joint.angle < report_jump) continue;
    while (i < pieces.size() && pieces[i].segment < joint.next) ++i;
    if (rest[joint.next]) continue;
    if (i == pieces.size()) break;
    SmallJoint report{joint.s, joint.angle, factor * pieces[i].v, {}};
    for (std::size_t k = 0; k < axes; ++k) report.step.push_back(joint.step[k] * report.velocity);
    plan.joints.push_back(std::move(report));
  }
}

std::string still_note(const AxisLimits& axis, double height) {
  char text[120];
  std::snprintf(text, sizeof text, "axis %s stands still at %.6g mm: the contour is planar", axis.name.c_str(), height);
  return text;
}

}  // namespace

ContourPlan plan_contour(Contour input, const Machine& machine, const ContourPlanning& planning, Progress& progress) {
  if (planning.stop_at_mode_change) stop_at_mode_changes(input);
  const auto given = std::make_shared<const Contour>(std::move(input));
  const bool blended = planning.corner_mode == CornerMode::blend;
  const double read = blended ? 0.1 : 0.0, served = blended ? 0.95 : 1.0;
  std::shared_ptr<const Contour> contour = given;
  const std::size_t moving = std::min(machine.dimension(), given->dimension);
  if (blended)
    contour = std::make_shared<const Contour>(blend(*given, {planning.blend_tolerance, planning.corner_angle},
                                                    held_limits(machine, method_row(planning.method), moving), progress,
                                                    0.0, read));
  PathPlanning path;
  path.path = contour_axes(contour, machine.dimension());
  path.moving = contour_axes(contour, moving);
  path.machine = machine;
  path.feeds = contour->feeds();
  path.feeds_to_verify = feeds_to_hold(*contour, *given);
  path.rests = contour->rest_places();
  path.dwells = contour->rests;
  path.method = planning.method;
  path.options = planning;
  path.max_setpoints = planning.max_setpoints;
  path.blocks = contour.get();
  path.setpoints = [&](const std::shared_ptr<const PathMotion>& motion, std::size_t cycles) {
    return std::make_unique<ContourSetpoints>(motion, *contour, machine, cycles);
  };
  path.from = read;
  path.to = served;
  PathPlan planned = plan_along(path, progress);

  const TimeLaw& sampled = planned.motion->law();
  if (!given->rests.empty()) planned.verification.add(rest_check(*given, *contour, sampled, progress, served));
  if (blended)
    for (Check& check : tube_checks(*given, *contour, planning.blend_tolerance, progress, served, 1.0))
      planned.verification.add(std::move(check));

  ContourPlan plan;
  plan.notes = contour->notes;
  for (std::size_t k = contour->dimension; k < machine.dimension(); ++k)
    plan.notes.push_back(still_note(machine.axes[k], contour->height));
  plan.path_length = contour->path.length();
  plan.iterations = planned.iterations;
  plan.pieces = planned.pieces;
  plan.duration = planned.duration;
  plan.bound = planned.bound;
  report_blocks(*contour, sampled, planned.cycles.factor, plan);
  report_joints(*contour, moving, sampled, planned.cycles.factor, planning.corner_angle, plan, progress);
  plan.slow_lines = slow_lines(*planned.motion, held_limits(machine, method_row(planning.method), machine.dimension()),
                               path.feeds, planning.along, slow_lines_listed, progress, 1.0);
  plan.verification = std::move(planned.verification);
  plan.setpoints = std::move(planned.setpoints);
  plan.path = contour;
  return plan;
}

}  // namespace bahnwerk
