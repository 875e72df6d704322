#pragma once
/// The independent check of the setpoints of coarse and fine axes: that they add up to the head's, row by row.
#include <memory>
#include <vector>

#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

class Progress;

struct SumInput {
  const SetpointSource& setpoints;  ///< columns `<axis>`, `v<axis>`, `a<axis>` of head, coarse and fine axes
  const std::vector<AxisLimits>&head, coarse, fine;  ///< names; a fine axis' stroke is its `highest`
  double progress_from = 0, progress_to = 1;
};

/// With ε = 2⁻⁵²:
///
/// `setpoints sum`                   mm     |x_c + x_f − x|, added up without rounding: 1e-12
/// `setpoints sum of velocities`     mm/s   the same of them: 32 ε (|v| + |v_c|)
/// `setpoints sum of accelerations`  mm/s²  the same of them: 32 ε (|a| + |a_c|)
/// `setpoints stroke`                mm     |x_f| against the stroke, of the axis that comes nearest to it
/// `setpoints fine velocity`         mm/s   |v_f| against its limit, likewise
/// `setpoints fine acceleration`     mm/s²  |a_f| against its limit, likewise
///
/// Missing columns and what is not a number fail.
std::unique_ptr<RowCheck> sum_row_check(const SumInput& input);

/// Reads all rows for that check alone.
std::vector<Check> sum_checks(const SumInput& input, Progress& progress);

}  // namespace bahnwerk
