#pragma once
/// Maps of a needle's clearance in a slot side by side as SVG [Herrmann Fig. 4.16].
#include <span>
#include <string>

#include "core/winding/needle/clearance_map.hpp"

namespace bahnwerk::winding {

struct DrawnClearance {
  std::string title;
  ClearanceMap map;
};

/// Draws the slot with its tooth tips, each cell coloured by the clearance of a needle whose tip is there: red where it
/// does not fit, from yellow to green in steps up to the largest clearance of all maps. The legend gives the accessible
/// share of the slot for each map.
std::string clearance_drawing(const StatorIron& iron, std::span<const DrawnClearance> maps, const std::string& title);

}  // namespace bahnwerk::winding
