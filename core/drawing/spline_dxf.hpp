#pragma once
/// Paths as a DXF drawing of SPLINE entities, release 2000 (AC1015), in mm: degree, knots, control points of space and
/// weights as they are, so that nothing is approximated. [Autodesk: DXF Reference]
#include <span>
#include <string>

#include "core/geometry/spline/nurbs_path.hpp"

namespace bahnwerk {

/// One SPLINE per path on one layer, with the tables, blocks and objects that strict readers ask for. The two angles of
/// the needle have no place in a drawing and are left out. Numbers are the shortest that read back as the same doubles.
/// Weights are written only where they differ from 1. `layer` is a name that needs no escaping: letters, digits, "_",
/// "-"; throws std::invalid_argument otherwise. O(points).
std::string splines_as_dxf(std::span<const NurbsPath> paths, const std::string& layer = "needle");

}  // namespace bahnwerk
