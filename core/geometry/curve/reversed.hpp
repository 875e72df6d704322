#pragma once
/// A curve traversed from its end to its beginning, with a parameter over [0, 1]. Its shape is unchanged but for
/// rounding, some 1e-15 of its extent and of its coordinates.
#include <memory>

#include "core/geometry/curve/curve.hpp"

namespace bahnwerk {

/// Returns a curve of the type of `curve`. O(degree²).
std::shared_ptr<const Curve> reversed(const Curve& curve);

}  // namespace bahnwerk
