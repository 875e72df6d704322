#pragma once
/// The least distance of the needle from part and winding tools along the whole path of a winding plan.
#include <cstddef>
#include <string>
#include <vector>

#include "core/plan/winding/winding_plan.hpp"
#include "core/winding/needle/part_obstacles.hpp"

namespace bahnwerk {

/// Returns the obstacles that are present while a coil of the request is wound. Throws like winding::part_obstacles().
winding::PartObstacles coil_obstacles(const WindingRequest& request, std::size_t coil);

struct PathClearance {
  winding::Clearance least;  ///< its `move` is an index in path.pieces; infinite without obstacles
  std::string nearest;       ///< name of the nearest obstacle, such as "stack"
};

/// Returns the least clearance, proven to 0.001 mm, coil by coil with the obstacles that are present while that coil is
/// wound. Reports fractions 0 to 1. Throws what winding::clearance() throws.
PathClearance path_clearance(const WindingRequest& request, const std::vector<winding::FixedPiece>& support,
                             const winding::NeedlePath& path, Progress progress);

inline constexpr std::size_t most_clearance_intervals = 2000;

/// Returns the curve with at most most_clearance_intervals intervals: equal parts of the parameters of pieces, or rows
/// of pieces where there are many. `tool` is the path made of the pieces. Reports fractions from 0 to 1.
ClearanceCurve clearance_curve(const WindingRequest& request, const std::vector<winding::FixedPiece>& support,
                               const winding::NeedlePath& path, const Path& tool, Progress progress);

}  // namespace bahnwerk
