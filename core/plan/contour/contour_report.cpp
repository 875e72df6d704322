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
  std::snprintf(text, sizeof text, "axis %s stands still at %.6g %s: the contour is planar", axis.name.c_str(), height,
                axis.unit == "rad" ? "deg" : axis.unit.c_str());
  return text;
}

}  // namespace

void report_blocks(const Contour& contour, const SampledLaw& sampled, ContourPlan& plan) {
  const std::vector<BlockTime> times = block_times(contour, sampled.law);
  for (std::size_t b = 0; b < times.size(); ++b) {
    const Block& block = contour.blocks[b];
    BlockReport report{block.mode, times[b].begin, times[b].end, 0};
    if (block.last > block.first) report.length = contour.path[block.last - 1].s1() - contour.path[block.first].s0();
    (block.mode == Mode::cut ? plan.cut_time : plan.position_time) +=
        (report.end_time - report.start_time) / sampled.factor;
    plan.blocks.push_back(report);
  }
}

namespace {
/// `step(joint)` returns the step of q′ of each axis.
template <class Step>
void add_joints(const Contour& contour, const Step& step, const SampledLaw& sampled, double corner_angle,
                ContourPlan& plan, Progress progress) {
  std::size_t i = 0;
  const auto& pieces = sampled.law.pieces();
  const std::vector<bool> rest = contour.rest_places();
  ProgressScope stage_progress(progress, "verify");
  for (const Joint& joint : joints(contour.path, &stage_progress)) {
    if (joint.angle > corner_angle || joint.angle < report_jump) continue;
    while (i < pieces.size() && pieces[i].segment < joint.next) ++i;
    if (rest[joint.next]) continue;
    if (i == pieces.size()) break;
    SmallJoint report{joint.s, joint.angle, sampled.factor * pieces[i].v, step(joint)};
    for (double& each : report.step) each *= report.velocity;
    plan.joints.push_back(std::move(report));
  }
}
}  // namespace

void report_joints(const Contour& contour, std::size_t axes, const SampledLaw& sampled, double corner_angle,
                   ContourPlan& plan, Progress progress) {
  const auto step = [&](const Joint& joint) {
    std::vector<double> steps;
    for (std::size_t k = 0; k < axes; ++k) steps.push_back(joint.step[k]);
    return steps;
  };
  add_joints(contour, step, sampled, corner_angle, plan, progress);
}

void report_joints(const Contour& contour, const ShownAxes& axes, const SampledLaw& sampled, double corner_angle,
                   ContourPlan& plan, Progress progress) {
  const AxisPath& path = axes.path;
  if (axes.factors.empty()) return report_joints(contour, path.axes(), sampled, corner_angle, plan, progress);
  const auto step = [&](const Joint& joint) {
    const AxisJet before = path.at_parameter(joint.next - 1, path[joint.next - 1].curve().end()),
                  after = path.at_parameter(joint.next, path[joint.next].curve().begin());
    std::vector<double> steps;
    for (std::size_t k = 0; k < path.axes(); ++k) steps.push_back(axes.factors[k] * (after.d1[k] - before.d1[k]));
    return steps;
  };
  add_joints(contour, step, sampled, corner_angle, plan, progress);
}

void note_still_axes(const ShownAxes& axes, const Machine& machine, ContourPlan& plan) {
  const AxisPath& path = axes.path;
  const AxisArray rates = largest_rates(path);
  for (std::size_t k = 0; k < path.axes(); ++k) {
    if (rates[k] > 0) continue;
    const double at = axes.factors[k] * path.at_parameter(0, path[0].curve().begin()).value[k];
    plan.notes.push_back(still_note(machine.axes[k], at));
  }
}

void note_still_axes(const Contour& contour, const Machine& machine, ContourPlan& plan) {
  for (std::size_t k = contour.dimension; k < machine.dimension(); ++k)
    plan.notes.push_back(still_note(machine.axes[k], contour.height));
}

}  // namespace bahnwerk
