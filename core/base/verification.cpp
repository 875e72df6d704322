#include "core/base/verification.hpp"

namespace bahnwerk {

Bound with_gap(Bound bound, double planned) {
  if (bound.sense == BoundSense::lower)
    bound.gap = bound.value > 0 ? (planned - bound.value) / bound.value : 0;
  else
    bound.gap = planned > 0 ? bound.value / planned - 1 : 0;
  if (bound.gap < 0 && bound.gap > -1e-14) bound.gap = 0;
  return bound;
}

}  // namespace bahnwerk
