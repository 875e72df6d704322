#pragma once
/// Readers of slots, winding heads and wires, which several kinds of documents contain.
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "api/members.hpp"
#include "core/base/errors.hpp"
#include "core/base/number_text.hpp"
#include "core/winding/laying/laying_regions.hpp"
#include "core/winding/slot/slot.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk::api {

/// Place of a member in a spec: names from the spec down.
using Place = std::vector<std::string>;
/// Returns the place of a member of the object at `place`.
Place below(Place place, const std::string& member);

/// Returns a number with four significant digits, for messages.
inline std::string short_number(double value) { return number_text(value, 4); }
/// Returns it with as many as distinguish it from `other`, with which the message compares it.
inline std::string short_number(double value, double other) { return number_text(value, other, 4); }

/// Read a slot from a document that passed its schema; they ignore a member "type".
winding::StatorSlot stator_slot(const nlohmann::json& document);
winding::PolygonSlot polygon_slot(const nlohmann::json& document);
winding::RotorSlot rotor_slot(const nlohmann::json& document);

/// Reads winding heads from members of `document`, which has the place `place`; defaults are those of the slot or the
/// source. Pitch and span are not read. Adds faults for impossible values.
winding::StatorHeads stator_heads(const nlohmann::json& document, const winding::StatorSlot& slot, const Place& place,
                                  std::vector<InputFault>& faults);
winding::RotorHeads rotor_heads(const nlohmann::json& document, const Place& place, std::vector<InputFault>& faults);

/// Reads a standard wire by its copper diameter, or any wire by its diameters; adds a fault if it is invalid.
std::optional<winding::Wire> read_wire(const nlohmann::json& value, const Place& place, int grade,
                                       std::vector<InputFault>& faults);
/// Returns the wires of a standard series on both sides of a diameter that none has, in words: "0.9 and 0.95".
std::string neighbouring_wires(double copper, int grade, winding::Series series);

}  // namespace bahnwerk::api
