#pragma once
/// The least distance of the needle from part and winding tools along the whole path of a winding plan.
#include <string>
#include <vector>

#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk {

struct PathClearance {
  winding::Clearance least;  ///< its `move` is an index in path.pieces; infinite without obstacles
  std::string nearest;       ///< name of the nearest obstacle, such as "stack"
};

/// Returns the least clearance, proven to 0.001 mm, coil by coil with the obstacles that are present while that coil is
/// wound. Reports fractions 0 to 1. Throws what winding::clearance() throws.
PathClearance path_clearance(const WindingRequest& request, const std::vector<winding::FixedPiece>& support,
                             const winding::NeedlePath& path, Progress& progress);

}  // namespace bahnwerk
