#pragma once
/// What kinds fill_factor and winding say of whether a coil can be wound. Wires are counted from 1.
#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "core/winding/laying/windable.hpp"

namespace bahnwerk::api {

/// What stands in the way of the first `wires` of the layout.
nlohmann::ordered_json blocked_by(const winding::Windable& verdict, std::size_t wires);
/// The first of them that slips, or null.
nlohmann::ordered_json slips(const winding::Windable& verdict, std::size_t wires);
/// How many wires can be wound, the turns that they make, and what ends them; null: the layout does, of `places` wires.
nlohmann::ordered_json windable(const winding::Windable& verdict, std::size_t parallel, std::size_t places);

}  // namespace bahnwerk::api
