#pragma once
/// A part, the places of its coils and their tools as lines in space, for drawings of the needle's path.
#include <vector>

#include "core/geometry/curve/vec.hpp"
#include "core/winding/needle/obstacles.hpp"
#include "core/winding/part/part.hpp"

namespace bahnwerk::winding {

using Polyline3 = std::vector<Vec>;

/// Returns slots, tooth tips and bore at both ends of the stack, and the corners of the tooth tips between them.
std::vector<Polyline3> part_outline(const StatorPart& part, const Slot& slot);
/// Returns poles and hub at both ends of the end caps' grooves, and the shoes' corners between them.
std::vector<Polyline3> part_outline(const RotorPart& part, const Slot& slot);

/// Returns the lines of the two slots of a stator's coil, or of the pole of a rotor's.
std::vector<Polyline3> coil_outline(const StatorPart& part, const Slot& slot, Coil coil);
std::vector<Polyline3> coil_outline(const RotorPart& part, const Slot& slot, Coil coil);

/// Returns the edges of the posts of a coil's winding tools, see tool_posts().
std::vector<Polyline3> post_outline(const StatorPart& part, const ToolPost& post, Coil coil);

/// A slot's number, and the point outside of the part's upper end at which it is written.
struct SlotLabel {
  Vec at;
  int slot = 0;
  bool marked = false;  ///< whether a coil is wound through it
};
std::vector<SlotLabel> slot_labels(const StatorPart& part, const std::vector<Coil>& coils);
std::vector<SlotLabel> slot_labels(const RotorPart& part, const std::vector<Coil>& coils);

}  // namespace bahnwerk::winding
