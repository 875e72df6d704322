#include "core/motion/grid/sections.hpp"

#include <cmath>

namespace bahnwerk {

namespace {

/// Returns the jump of q′.
AxisArray step(const AxisPath& path, const Joint& joint) {
  AxisArray jump{};
  if (path.cartesian()) {
    for (std::size_t k = 0; k < path.axes(); ++k) jump[k] = joint.step[k];
    return jump;
  }
  const AxisJet before = path.at_parameter(joint.next - 1, path[joint.next - 1].curve().end()),
                after = path.at_parameter(joint.next, path[joint.next].curve().begin());
  for (std::size_t k = 0; k < path.axes(); ++k) jump[k] = after.d1[k] - before.d1[k];
  return jump;
}

}  // namespace

Sections find_sections(const PathTask& task, double corner_angle, ProgressScope& progress) {
  Sections sections;
  const AxisPath& path = task.path;
  sections.begin.push_back(0);
  sections.joint_cap.assign(path.size(), unlimited);
  for (const Joint& joint : joints(path.tool(), &progress)) {
    if (task.rests[joint.next] || joint.angle > corner_angle || path[joint.next].cusp_begin() ||
        path[joint.next - 1].cusp_end()) {
      sections.begin.push_back(joint.next);
      continue;
    }
    double speed = unlimited;
    const AxisArray jump = step(path, joint);
    for (std::size_t k = 0; k < path.axes(); ++k)
      if (const double size = std::abs(jump[k]); size > 0)
        speed = std::min(speed, task.machine.axes[k].acceleration * task.machine.cycle_time / size);
    sections.joint_cap[joint.next] = speed * speed;
  }
  sections.begin.push_back(path.size());
  return sections;
}

}  // namespace bahnwerk
