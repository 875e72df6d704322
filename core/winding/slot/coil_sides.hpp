#pragma once
/// A slot that two coil sides share.
#include "core/winding/slot/slot.hpp"

namespace bahnwerk::winding {

enum class Sharing {
  beside,  ///< side by side in tangential direction, as coils about single teeth
  layers,  ///< one above the other, as coils over several teeth
};

struct SharedSlot {
  Slot slot;    ///< usable_area is the half of the side that is wound second, `taken` that of the other side
  Region back;  ///< the half of this coil in its other slot
};

/// Returns the halves of the slot's usable area. `beside` splits it by the upright line through the middle of the
/// opening, or of the slot where it has none; the first slot's half is the left one (opening at the top), the coil's
/// other half the right one: a tooth lies between them. `layers` splits it across at equal areas; the first slot's half
/// is the upper one, on top of a coil side laid before, the coil's other half the lower one. A rotor's usable area is
/// already that of one coil side and is unchanged. Throws InvalidInput where a half has no area.
SharedSlot shared(const Slot& slot, Sharing how);

}  // namespace bahnwerk::winding
