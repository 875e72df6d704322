#include "core/motion/setpoints/contour_setpoints.hpp"

#include <algorithm>

#include "core/motion/law/block_times.hpp"

namespace bahnwerk {

ContourSetpoints::ContourSetpoints(const std::shared_ptr<const PathMotion>& motion, const Contour& contour,
                                   const Machine& machine, std::size_t cycles)
    : PathSetpoints(motion, machine, cycles) {
  add_column({"mode", "1"});
  add_column({"block", "1"});
  const std::vector<BlockTime> times = block_times(contour, motion->law());
  for (std::size_t b = 0; b < times.size(); ++b)
    if (times[b].end > times[b].begin || contour.blocks[b].last > contour.blocks[b].first)
      labels_.push_back({times[b].begin, b, contour.blocks[b].mode == Mode::cut});
  if (labels_.empty()) labels_.push_back({0, 0, true});
}

void ContourSetpoints::write(Row& row, double* out) const {
  PathSetpoints::write(row, out);
  out += path_columns();
  if (row.place == Row::unknown) {
    const auto later = std::upper_bound(labels_.begin(), labels_.end(), row.t,
                                        [](double t, const Label& label) { return t < label.begin; });
    row.place = later == labels_.begin() ? 0 : static_cast<std::size_t>(later - labels_.begin()) - 1;
  }
  while (row.place + 1 < labels_.size() && labels_[row.place + 1].begin <= row.t) ++row.place;
  const Label& label = labels_[row.place];
  out[0] = label.cut ? 1 : 0;
  out[1] = static_cast<double>(label.block);
}

}  // namespace bahnwerk
