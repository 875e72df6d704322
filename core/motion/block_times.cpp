#include "core/motion/block_times.hpp"

namespace bahnwerk {

std::vector<BlockTime> block_times(const Contour& contour, const MotionLaw& law) {
  std::vector<BlockTime> times;
  times.reserve(contour.blocks.size());
  const auto& pieces = law.pieces();
  std::size_t i = 0;
  double t = 0;
  for (const Block& block : contour.blocks) {
    const double begin = t;
    while (i < pieces.size() && pieces[i].segment < block.last) ++i;  // a piece never spans two segments
    t = i < pieces.size() ? pieces[i].t0 : law.duration();
    times.push_back({begin, t});
  }
  return times;
}

}  // namespace bahnwerk
