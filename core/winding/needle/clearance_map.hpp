#pragma once
/// The accessible part of a stator's slot for a needle's tip, with and without pivot shift: the map of [Herrmann Fig.
/// 4.16]. Lengths mm, angles rad.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/winding/needle/clearance.hpp"

namespace bahnwerk::winding {

/// Returns the pose of a needle inside the stack whose tip is at `tip`, in slot coordinates of slot 0: it points away
/// from the axis or, with a limit, from the middle of the tooth opening as far as the limit allows (slot_support).
NeedlePose tip_pose(const StatorPart& part, Point tip, std::optional<double> pivot_limit);
/// Returns the least clearance of that needle, to within `tolerance`; some 0.1 ms. Throws like clearance(). For the
/// wires of a layout, use their places as tips, or their support points' poses and clearance().
double tip_clearance(const StatorPart& part, const StatorIron& iron, const NeedleShape& needle, Point tip,
                     std::optional<double> pivot_limit, double tolerance = 1e-3);

/// Clearances at the middles of square cells; NaN where the tip would be outside the slot.
struct ClearanceMap {
  Point low;  ///< corner of the first cell
  double step = 0;
  std::size_t columns = 0, rows = 0;
  std::vector<double> values;  ///< row by row, from the base up
  Point middle(std::size_t column, std::size_t row) const {
    return low + step * Point{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
  }
  double at(std::size_t column, std::size_t row) const { return values[row * columns + column]; }
  /// Returns the share of the slot's cells with at least this clearance.
  double share(double clearance) const;
};

/// Computes the map over the slot as punched. Asks `progress`. Throws std::invalid_argument for a step that is not
/// positive or gives more than a million cells.
ClearanceMap clearance_map(const StatorPart& part, const Slot& slot, const NeedleShape& needle,
                           std::optional<double> pivot_limit, double step, Progress progress);

}  // namespace bahnwerk::winding
