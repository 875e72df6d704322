#pragma once
/// The length of wire in the turns of a winding.
#include <variant>
#include <vector>

#include "core/winding/part/turns.hpp"

namespace bahnwerk::winding {

/// Returns the length through the places of all wires, mm: straight through slots and along a rotor's end caps, on an
/// arc about the axis behind a stator's winding tools, straight between regions and from turn to turn. Leads and the
/// wire between coils are not included. O(turns).
double wire_length(const std::variant<StatorPart, RotorPart>& part, const std::vector<Coil>& coils,
                   const std::vector<Turn>& turns);

}  // namespace bahnwerk::winding
