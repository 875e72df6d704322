#pragma once
/// The outline of a part's stack as lines in space, for drawings of the needle's path.
#include <vector>

#include "core/geometry/curve/vec.hpp"
#include "core/winding/part/part.hpp"

namespace bahnwerk::winding {

using Polyline3 = std::vector<Vec>;

/// Returns slots, tooth tips and bore at both ends of the stack, and the corners of the tooth tips between them.
std::vector<Polyline3> part_outline(const StatorPart& part, const Slot& slot);
/// Returns poles and hub at both ends of the end caps' grooves, and the shoes' corners between them.
std::vector<Polyline3> part_outline(const RotorPart& part, const Slot& slot);

}  // namespace bahnwerk::winding
