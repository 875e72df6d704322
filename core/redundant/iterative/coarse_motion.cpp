#include "core/redundant/iterative/coarse_motion.hpp"

#include <algorithm>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double apart = 1e-11;  // s: knots that are closer are one

}  // namespace

std::shared_ptr<const SplineMotion> coarse_motion(const std::vector<TimeSpline>& axes, double duration) {
  std::vector<double> ends;
  for (const TimeSpline& axis : axes)
    for (std::size_t i = 0; i < axis.pieces(); ++i) ends.push_back(axis.end(i));
  std::sort(ends.begin(), ends.end());
  std::vector<SplineMotion::Piece> pieces;
  std::vector<std::size_t> at(axes.size(), 0);
  double begin = 0;
  ends.push_back(duration);
  for (double end : ends) {
    const bool last = end >= duration - apart;
    if (last) end = duration;
    if (!(end > begin + apart) && !(last && end > begin)) continue;
    SplineMotion::Piece piece;
    piece.end = end;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      at[k] = axes[k].find(0.5 * (begin + end), at[k]);
      const TimeSpline::Coefficients c = axes[k].from(at[k], begin);
      piece.axes.emplace_back(c.begin(), c.end());
    }
    pieces.push_back(std::move(piece));
    begin = end;
    if (last) break;
  }
  return std::make_shared<const SplineMotion>(std::move(pieces));
}

}  // namespace bahnwerk
