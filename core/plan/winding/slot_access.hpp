#pragma once
/// The part of a stator's slot that the needle of a job can reach, with and without its pivot shift [Herrmann Fig.
/// 4.16].
#include <optional>
#include <string>
#include <vector>

#include "core/plan/winding/winding_plan.hpp"
#include "core/winding/drawing/clearance_drawing.hpp"

namespace bahnwerk {

struct SlotAccess {
  double step = 0;  ///< mm, width of the cells
  std::vector<winding::DrawnClearance>
      maps;                    ///< the map without pivot shift; then the one with it, if the request has one
  std::vector<double> shares;  ///< share of the slot's cells that keep least_clearance (1) in each map
  std::string drawing;         ///< SVG
};

/// Returns the maps; none for a rotor, whose slots are open. About 500 cells in all, 0.05 to 0.1 s. Throws Stopped.
std::optional<SlotAccess> slot_access(const WindingRequest& request, Progress progress);

}  // namespace bahnwerk
