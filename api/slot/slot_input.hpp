#pragma once
/// What several kinds of documents say of slots, winding heads and wires.
#include <cstdio>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/winding/laying/laying_regions.hpp"
#include "core/winding/slot/slot.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk::api {

/// Where something stands in a spec.
using Place = std::vector<std::string>;
Place below(Place place, const std::string& member);

inline std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// Returns a member that may be absent or null.
template <class T, class Json>
std::optional<T> given(const Json& object, const char* member) {
  const auto at = object.find(member);
  if (at == object.end() || at->is_null()) return std::nullopt;
  return at->template get<T>();
}
/// Reads such a member into a variable, which keeps its value otherwise; `unit` is one of the document's units in
/// core's.
template <class T, class Json>
void take(const Json& object, const char* member, T& value) {
  if (const auto v = given<T>(object, member)) value = *v;
}
template <class Json>
void take(const Json& object, const char* member, double& value, double unit) {
  if (const auto v = given<double>(object, member)) value = unit * *v;
}

/// Read a slot from a document that passed its schema; a member "type" is not looked at.
winding::StatorSlot stator_slot(const nlohmann::json& document);
winding::PolygonSlot polygon_slot(const nlohmann::json& document);
winding::RotorSlot rotor_slot(const nlohmann::json& document);

/// Reads winding heads from members of `document`, which stands at `place`; each has a default that is taken from the
/// slot or the source's. Pitch and span keep theirs. Adds a fault for what is impossible.
winding::StatorHeads stator_heads(const nlohmann::json& document, const winding::StatorSlot& slot, const Place& place,
                                  std::vector<InputFault>& faults);
winding::RotorHeads rotor_heads(const nlohmann::json& document, const Place& place, std::vector<InputFault>& faults);

/// Reads a standard wire by its copper diameter, or any wire by its diameters; adds a fault if it is none.
std::optional<winding::Wire> read_wire(const nlohmann::json& value, const Place& place, int grade,
                                       std::vector<InputFault>& faults);
/// Returns the standard wires on both sides of a diameter that none has, in words: "0.9 and 0.95".
std::string neighbouring_wires(double copper, int grade);

}  // namespace bahnwerk::api
