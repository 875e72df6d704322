#include "core/motion/axes/axis_path.hpp"

#include <algorithm>

#include "core/base/errors.hpp"

namespace bahnwerk {

CartesianAxisPath::CartesianAxisPath(const Path& tool, std::size_t axes, double height)
    : AxisPath(tool, std::min<std::size_t>(axes, 3), true), height_(height) {}

AxisJet CartesianAxisPath::axes_at(const PathPoint& p) const {
  AxisJet q;
  for (std::size_t k = 0; k < axes(); ++k)
    q.value[k] = p.value[k], q.d1[k] = p.d1[k], q.d2[k] = p.d2[k], q.d3[k] = p.d3[k];
  if (axes() == 3) q.value[2] += height_;
  return q;
}

MapBounds CartesianAxisPath::map_bounds(const Vec&, double) const {
  MapBounds bounds;
  for (std::size_t k = 0; k < axes(); ++k) bounds.order[0][k] = 1;
  return bounds;
}

KinematicAxisPath::KinematicAxisPath(const Path& tool, const Kinematics& kinematics)
    : AxisPath(tool, kinematics.axes().size(), false), kinematics_(kinematics) {}

AxisJet KinematicAxisPath::at_parameter(std::size_t segment, double u) const {
  try {
    return kinematics_.inverse(tool()[segment].at_parameter(u));
  } catch (const UnreachablePose& e) {
    throw UnreachablePose(e.what(), tool()[segment].arc_length(u));  // only the path knows where on it that is
  }
}

void KinematicAxisPath::at_parameters(std::size_t segment, PathBatch& batch) const {
  batch.close();
  batch.planar = false;
  for (std::size_t i = 0; i < 2 * batch.used_pairs(); ++i) {
    const AxisJet q = at_parameter(segment, batch.u[i]);
    batch.s.set(i, tool()[segment].travelled(batch.u[i]));
    for (std::size_t k = 0; k < axes(); ++k)
      batch.d1[k].set(i, q.d1[k]), batch.d2[k].set(i, q.d2[k]), batch.d3[k].set(i, q.d3[k]);
  }
}

}  // namespace bahnwerk
