#include "core/redundant/known/split_path.hpp"

namespace bahnwerk {

AxisJet SplitPath::split(std::size_t segment, double s, const AxisJet& tool) const {
  const std::size_t n = path_->axes();
  AxisJet q = coarse_->at(segment, s, tool);
  for (std::size_t k = 0; k < n; ++k) {
    q.value[n + k] = tool.value[k] - q.value[k];
    q.d1[n + k] = tool.d1[k] - q.d1[k];
    q.d2[n + k] = tool.d2[k] - q.d2[k];
    q.d3[n + k] = tool.d3[k] - q.d3[k];
  }
  return q;
}

AxisJet SplitPath::at_parameter(std::size_t segment, double u) const {
  return split(segment, tool()[segment].arc_length(u), path_->at_parameter(segment, u));
}

void SplitPath::at_parameters(std::size_t segment, PathBatch& batch) const {
  path_->at_parameters(segment, batch);
  const std::size_t n = path_->axes();
  const double begin = tool()[segment].s0();
  const bool flat = batch.planar && n > 2;  // what nobody wrote is 0
  batch.planar = false;
  for (std::size_t i = 0; i < batch.count; ++i) {
    AxisJet at;
    for (std::size_t k = 0; k < (flat ? 2 : n); ++k)
      at.d1[k] = batch.d1[k][i], at.d2[k] = batch.d2[k][i], at.d3[k] = batch.d3[k][i];
    write_row(batch, i, split(segment, begin + batch.s[i], at));
  }
}

}  // namespace bahnwerk
