#pragma once
/// Paths as a DXF drawing of SPLINE entities, release 2000 (AC1015), in mm: degree, knots, control points of space and
/// weights, without approximation [Autodesk: DXF Reference].
#include <span>
#include <string>

#include "core/geometry/spline/nurbs_path.hpp"

namespace bahnwerk {

/// Writes one SPLINE per path on one layer, with the tables, blocks and objects that strict readers require. The two
/// angles of the needle are not part of a drawing. Numbers are the shortest that read back as equal doubles. Weights
/// are written only where they differ from 1. `layer` is a name that needs no escaping: letters, digits, "_", "-";
/// throws std::invalid_argument otherwise. O(points).
std::string splines_as_dxf(std::span<const NurbsPath> paths, const std::string& layer = "needle");

}  // namespace bahnwerk
