#include "core/redundant/known/split_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bahnwerk {

std::vector<RedundancyPeaks> split_peaks(const Motion& head, const Motion& coarse, ProgressScope& scope) {
  return std::move(split_peaks(head, coarse, {}, scope).front());
}

std::vector<std::vector<RedundancyPeaks>> split_peaks(const Motion& head, const Motion& coarse,
                                                      const std::vector<double>& borders, ProgressScope& scope) {
  const std::size_t axes = coarse.axes();
  std::vector<std::vector<RedundancyPeaks>> all(borders.size() + 1, std::vector<RedundancyPeaks>(axes));
  std::size_t h = 0, c = 0, part = 0;
  for (double t = 0; h < head.pieces() && c < coarse.pieces();) {
    const double end = std::min(head.end(h), coarse.end(c));
    while (part < borders.size() && 0.5 * (t + end) > borders[part]) ++part;
    std::vector<RedundancyPeaks>& peaks = all[part];
    if (end > t)
      for (int i = 0; i <= 4; ++i) {
        const double at = t + 0.25 * i * (end - t);
        const MotionState x = head.in_piece(h, at), g = coarse.in_piece(c, at);
        for (std::size_t k = 0; k < axes; ++k) {
          RedundancyPeaks& p = peaks[k];
          p.offset = std::fmax(p.offset, std::abs(x[0][k] - g[0][k]));
          p.coarse_velocity = std::fmax(p.coarse_velocity, std::abs(g[1][k]));
          p.coarse_acceleration = std::fmax(p.coarse_acceleration, std::abs(g[2][k]));
          p.fine_velocity = std::fmax(p.fine_velocity, std::abs(x[1][k] - g[1][k]));
          p.fine_acceleration = std::fmax(p.fine_acceleration, std::abs(x[2][k] - g[2][k]));
        }
      }
    t = std::fmax(t, end);
    const bool head_ends = head.end(h) <= end;
    if (coarse.end(c) <= end) ++c;
    if (head_ends) ++h;
    scope.work(8);
  }
  return all;
}

double SplitUse::most() const {
  return std::max({coarse_velocity, coarse_acceleration, offset, fine_velocity, fine_acceleration});
}

SplitUse use_of(const std::vector<RedundancyPeaks>& peaks, const CoarseFineMachine& machine) {
  SplitUse use;
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    const CoarseFineAxis& axis = machine.axes[k];
    use.coarse_velocity = std::fmax(use.coarse_velocity, peaks[k].coarse_velocity / axis.coarse.velocity);
    use.coarse_acceleration =
        std::fmax(use.coarse_acceleration, peaks[k].coarse_acceleration / axis.coarse.acceleration);
    use.offset = std::fmax(use.offset, peaks[k].offset / axis.stroke);
    use.fine_velocity = std::fmax(use.fine_velocity, peaks[k].fine_velocity / axis.fine.velocity);
    use.fine_acceleration = std::fmax(use.fine_acceleration, peaks[k].fine_acceleration / axis.fine.acceleration);
  }
  return use;
}

}  // namespace bahnwerk
