#pragma once
/// The independent check that setpoints of coarse and fine axes add up to the head's setpoints, row by row.
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

struct SumInput {
  const SetpointSource& setpoints;  ///< columns `<axis>`, `v<axis>`, `a<axis>` of head, coarse and fine axes
  const std::vector<AxisLimits>&head, coarse, fine;  ///< names; a fine axis' stroke is its `highest`
};

/// Returns a check of rows with these quantities and limits (ε = 2⁻⁵²):
///
/// `setpoints sum`                   mm     |x_c + x_f − x|, added without rounding: 1e-12
/// `setpoints sum of velocities`     mm/s   |v_c + v_f − v|: 32 ε (|v| + |v_c|)
/// `setpoints sum of accelerations`  mm/s²  |a_c + a_f − a|: 32 ε (|a| + |a_c|)
/// `setpoints stroke`                mm     |x_f|: the stroke
/// `setpoints fine velocity`         mm/s   |v_f|: the fine axis' limit
/// `setpoints fine acceleration`     mm/s²  |a_f|: the fine axis' limit
///
/// The last three report the axis that comes nearest to its limit. Missing columns and values that are not finite fail.
std::unique_ptr<RowCheck> sum_row_check(const SumInput& input);

/// Reads all rows for sum_row_check() and returns its verdicts.
std::vector<Check> sum_checks(const SumInput& input, Progress progress);

}  // namespace bahnwerk
