#include "core/motion/axes/length_axis.hpp"

namespace bahnwerk {

AxisJet LengthAxisPath::at_parameter(std::size_t segment, double u) const {
  AxisJet q = path_.at_parameter(segment, u);
  q.value[last()] = tool()[segment].arc_length(u);
  q.d1[last()] = 1, q.d2[last()] = 0, q.d3[last()] = 0;
  return q;
}

void LengthAxisPath::at_parameters(std::size_t segment, PathBatch& batch) const {
  path_.at_parameters(segment, batch);
  const bool flat = batch.planar && last() > 2;  // the rows of z are not written
  batch.planar = false;
  for (std::size_t i = 0; i < 2 * batch.used_pairs(); ++i) {
    if (flat) batch.d1[2].set(i, 0), batch.d2[2].set(i, 0), batch.d3[2].set(i, 0);
    batch.d1[last()].set(i, 1), batch.d2[last()].set(i, 0), batch.d3[last()].set(i, 0);
  }
}

MapBounds LengthAxisPath::map_bounds(std::size_t segment, double u, double radius) const {
  MapBounds bounds = path_.map_bounds(segment, u, radius);
  bounds.order[0][last()] = 1;
  for (std::size_t n = 1; n < bounds.order.size(); ++n) bounds.order[n][last()] = 0;
  return bounds;
}

bool LengthAxisPath::enclose(std::size_t segment, double u, double radius, AxisDiscs& axes) const {
  if (!path_.enclose(segment, u, radius, axes)) return false;
  axes.d1[last()] = 1.0, axes.d2[last()] = 0.0, axes.d3[last()] = 0.0;
  return true;
}

}  // namespace bahnwerk
