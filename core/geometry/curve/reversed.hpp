#pragma once
/// A curve run from its end to its begin, its parameter over [0, 1]. Its shape is the same but for rounding: some 1e-15
/// of its extent and of its coordinates.
#include <memory>

#include "core/geometry/curve/curve.hpp"

namespace bahnwerk {

/// The result is of the same kind. O(degree²).
std::shared_ptr<const Curve> reversed(const Curve& curve);

}  // namespace bahnwerk
