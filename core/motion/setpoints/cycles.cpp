#include "core/motion/setpoints/cycles.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {

Cycles whole_cycles(double duration, double cycle_time) {
  Cycles cycles;
  cycles.count = static_cast<std::size_t>(std::max(1.0, std::ceil(duration / cycle_time)));
  // Division rounds; the motion may only ever be slowed.
  if (static_cast<double>(cycles.count) * cycle_time < duration) ++cycles.count;
  cycles.factor = static_cast<double>(cycles.count) * cycle_time / duration;
  return cycles;
}

}  // namespace bahnwerk
