#include "core/plan/coarse_fine/rms.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/gauss_legendre.hpp"

namespace bahnwerk {

RmsAccelerations rms_accelerations(const Motion& head, const Motion& coarse, ProgressScope& scope) {
  const std::size_t axes = coarse.axes(), moving = std::min(axes, head.axes());
  RmsAccelerations rms{std::vector<double>(axes, 0.0), std::vector<double>(axes, 0.0)};
  std::size_t h = 0, c = 0;
  for (double t = 0; h < head.pieces() && c < coarse.pieces();) {
    const double head_end = head.end(h), coarse_end = coarse.end(c), end = std::min(head_end, coarse_end);
    const double half = 0.5 * (end - t);
    for (const auto& [place, weight] : gauss_legendre<5>()) {
      if (!(half > 0)) break;
      const double at = t + half * (1 + place);
      const MotionState x = head.in_piece(h, at), g = coarse.in_piece(c, at);
      for (std::size_t k = 0; k < axes; ++k) {
        const double a = g[2][k], f = (k < moving ? x[2][k] : 0) - a;
        rms.coarse[k] += half * weight * a * a;
        rms.fine[k] += half * weight * f * f;
      }
    }
    t = std::max(t, end);
    if (coarse_end <= end) ++c;
    if (head_end <= end) ++h;
    scope.work(8);
  }
  const double duration = head.duration();
  for (std::vector<double>* list : {&rms.coarse, &rms.fine})
    for (double& value : *list) value = duration > 0 ? std::sqrt(value / duration) : 0;
  return rms;
}

}  // namespace bahnwerk
