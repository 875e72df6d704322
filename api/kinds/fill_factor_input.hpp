#pragma once
/// Parts of reading a spec of kind "fill_factor".
#include <cstdio>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk::api::fill_factor {

/// The wires of a spec that passed its schema; adds a fault for each that is none.
std::vector<winding::Wire> wires(const nlohmann::json& spec, int grade, std::vector<InputFault>& faults);

inline std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// A number that may be absent or null.
template <class T, class Json>
std::optional<T> given(const Json& object, const char* member) {
  const auto at = object.find(member);
  if (at == object.end() || at->is_null()) return std::nullopt;
  return at->template get<T>();
}

}  // namespace bahnwerk::api::fill_factor
