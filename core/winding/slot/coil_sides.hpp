#pragma once
/// A slot that two coil sides share.
#include "core/winding/slot/slot.hpp"

namespace bahnwerk::winding {

enum class Sharing {
  beside,  ///< tangentially side by side, as coils about single teeth lie
  layers,  ///< one above the other, as coils over several teeth lie
};

struct SharedSlot {
  Slot slot;    ///< its usable area is the half of the side that is wound second; `taken` is where the other one lies
  Region back;  ///< the half of the same coil in its other slot
};

/// Halves of the slot's usable area. `beside`: split by the upright through the middle of the opening, or of the slot
/// where it has none; the first slot's half is the left one (opening at the top), the coil's other half the right one:
/// a tooth lies between them. `layers`: split across at equal areas; the first slot's half is the upper one, on top of
/// a coil side laid before, the coil's other half the lower one. A rotor's usable area is that of one coil side already
/// and stays. Throws InvalidInput where a half has no area.
SharedSlot shared(const Slot& slot, Sharing how);

}  // namespace bahnwerk::winding
