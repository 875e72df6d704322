#pragma once
/// Whether fine axes stand in the middle of their strokes where a motion begins and ends.
#include <vector>

#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// Checks `centred at start <fine axis>` and `centred at end <fine axis>` of every axis k with centred[k]: |x − x_c|,
/// mm, against 1e-6 mm. Axes of all arguments are numbered alike. O(1).
std::vector<Check> centre_checks(const Motion& head, const Motion& coarse, const std::vector<AxisLimits>& fine_axes,
                                 const std::vector<bool>& centred);

}  // namespace bahnwerk
