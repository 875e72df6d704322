#include "core/geometry/curve/line.hpp"

namespace bahnwerk {

Jet Line::at(double u) const {
  // The point is computed from the nearer end, so that both end points are exact.
  return {u < 0.5 ? from_ + u * way_ : to_ - (1 - u) * way_, way_, {}, {}};
}

}  // namespace bahnwerk
