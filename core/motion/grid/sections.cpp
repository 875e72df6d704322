#include "core/motion/grid/sections.hpp"

#include <cmath>

namespace bahnwerk {

Sections find_sections(const Contour& contour, const Machine& machine, double corner_angle,
                       const std::function<void()>& pause) {
  Sections sections;
  const Path& path = contour.path;
  sections.begin.push_back(0);
  const std::vector<bool> rest = contour.rest_places();
  sections.joint_cap.assign(path.size(), unlimited);
  for (const Joint& joint : joints(path, pause)) {
    if (rest[joint.next] || joint.angle > corner_angle || path[joint.next].cusp_begin() ||
        path[joint.next - 1].cusp_end()) {
      sections.begin.push_back(joint.next);
      continue;
    }
    double speed = unlimited;
    for (std::size_t k = 0; k < machine.dimension(); ++k)
      if (const double step = std::abs(joint.step[k]); step > 0)
        speed = std::min(speed, machine.axes[k].acceleration * machine.cycle_time / step);
    sections.joint_cap[joint.next] = speed * speed;
  }
  sections.begin.push_back(path.size());
  return sections;
}

}  // namespace bahnwerk
