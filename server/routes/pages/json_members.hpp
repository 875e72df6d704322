#pragma once
/// Reading members of results that older versions may have written without them.
#include <nlohmann/json.hpp>
#include <optional>

namespace bahnwerk::server {

/// Returns the member of an object; null where it, or the object, is missing.
inline const nlohmann::ordered_json& member(const nlohmann::ordered_json& object, const char* name) {
  static const nlohmann::ordered_json none;
  if (!object.is_object()) return none;
  const auto found = object.find(name);
  return found != object.end() ? *found : none;
}

/// Returns the number at a member; nullopt where there is none.
inline std::optional<double> number_at(const nlohmann::ordered_json& object, const char* name) {
  const nlohmann::ordered_json& value = member(object, name);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

}  // namespace bahnwerk::server
