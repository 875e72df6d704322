#pragma once
/// The verdict on whether a coil can be wound, as the results of kinds fill_factor and winding report it. Wires are
/// counted from 1.
#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "core/winding/laying/windable.hpp"

namespace bahnwerk::api {

/// Returns the obstructions of the first `wires` of the layout.
nlohmann::ordered_json blocked_by(const winding::Windable& verdict, std::size_t wires);
/// Returns the first wire of them that slips, or null.
nlohmann::ordered_json slips(const winding::Windable& verdict, std::size_t wires);
/// Returns how many wires can be wound, the turns that they make, and what ends them; null if the layout, of `places`
/// wires, can be wound as a whole.
nlohmann::ordered_json windable(const winding::Windable& verdict, std::size_t parallel, std::size_t places);

}  // namespace bahnwerk::api
