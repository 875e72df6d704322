#pragma once
/// How much wire the turns of a winding take, and its resistance.
#include <variant>
#include <vector>

#include "core/winding/part/turns.hpp"

namespace bahnwerk::winding {

/// Through the places of all wires, mm: straight through slots and along a rotor's end caps, on an arc about the axis
/// behind a stator's winding tools, straight between regions and from turn to turn. Without leads and what the wire
/// takes from coil to coil. O(turns).
double wire_length(const std::variant<StatorPart, RotorPart>& part, const std::vector<Coil>& coils,
                   const std::vector<Turn>& turns);

}  // namespace bahnwerk::winding
