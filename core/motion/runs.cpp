#include "core/motion/runs.hpp"

#include <cmath>

namespace bahnwerk {

Runs find_runs(const Contour& contour, const Machine& machine, double corner_angle,
               const std::function<void()>& pause) {
  Runs runs;
  const Path& path = contour.path;
  runs.begin.push_back(0);
  const std::vector<bool> rest = contour.rest_places();
  runs.joint_cap.assign(path.size(), unlimited);
  for (const Joint& joint : joints(path, pause)) {
    if (rest[joint.next] || joint.angle > corner_angle || path[joint.next].cusp_begin() ||
        path[joint.next - 1].cusp_end()) {
      runs.begin.push_back(joint.next);
      continue;
    }
    double speed = unlimited;
    for (std::size_t k = 0; k < machine.dimension(); ++k)
      if (const double step = std::abs(joint.step[k]); step > 0)
        speed = std::min(speed, machine.axes[k].acceleration * machine.cycle_time / step);
    runs.joint_cap[joint.next] = speed * speed;
  }
  runs.begin.push_back(path.size());
  return runs;
}

}  // namespace bahnwerk
