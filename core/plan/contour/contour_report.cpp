#include "core/plan/contour/contour_report.hpp"

#include <cstdio>
#include <utility>

#include "core/base/progress_scope.hpp"
#include "core/motion/law/block_times.hpp"

namespace bahnwerk {
namespace {

constexpr double report_jump = 1e-9;  // rad; below it a tangent jump is rounding

std::string still_note(const AxisLimits& axis, double height) {
  char text[120];
  std::snprintf(text, sizeof text, "axis %s stands still at %.6g mm: the contour is planar", axis.name.c_str(), height);
  return text;
}

}  // namespace

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

void report_joints(const Contour& contour, std::size_t axes, const TimeLaw& sampled, double factor, double corner_angle,
                   ContourPlan& plan, Progress& progress, double progress_at) {
  std::size_t i = 0;
  const auto& pieces = sampled.pieces();
  const std::vector<bool> rest = contour.rest_places();
  ProgressScope stage_progress(progress, "verify", progress_at, progress_at);
  for (const Joint& joint : joints(contour.path, &stage_progress)) {
    if (joint.angle > corner_angle || joint.angle < report_jump) continue;
    while (i < pieces.size() && pieces[i].segment < joint.next) ++i;
    if (rest[joint.next]) continue;
    if (i == pieces.size()) break;
    SmallJoint report{joint.s, joint.angle, factor * pieces[i].v, {}};
    for (std::size_t k = 0; k < axes; ++k) report.step.push_back(joint.step[k] * report.velocity);
    plan.joints.push_back(std::move(report));
  }
}

void note_still_axes(const Contour& contour, const Machine& machine, ContourPlan& plan) {
  for (std::size_t k = contour.dimension; k < machine.dimension(); ++k)
    plan.notes.push_back(still_note(machine.axes[k], contour.height));
}

}  // namespace bahnwerk
