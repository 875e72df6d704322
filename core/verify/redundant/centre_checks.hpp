#pragma once
/// Checks that the fine axes are in the middle of their strokes at the begin and the end of a motion.
#include <vector>

#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// Returns the checks `centred at start <fine axis>` and `centred at end <fine axis>` for every axis k with centred[k]:
/// |x − x_c|, mm, with the limit 1e-6 mm. All arguments have the same number and order of axes. O(1).
std::vector<Check> centre_checks(const Motion& head, const Motion& coarse, const std::vector<AxisLimits>& fine_axes,
                                 const std::vector<bool>& centred);

}  // namespace bahnwerk
