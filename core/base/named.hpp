#pragma once
/// The names of an enumeration's values in documents: one table beside the enumeration, used in both directions. A name
/// or value that is not in the table is an error, never a default.
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace bahnwerk {

/// A value and its name.
template <class Enumeration>
struct Named {
  Enumeration value;
  const char* name;
};

/// Returns the name of a value. Throws std::logic_error for a value without one.
template <class Enumeration>
const char* name_of(Enumeration value, std::span<const Named<Enumeration>> table) {
  for (const auto& entry : table)
    if (entry.value == value) return entry.name;
  throw std::logic_error("a value without a name");
}

/// Returns the value of a name. Throws std::invalid_argument for an unknown one.
template <class Enumeration>
Enumeration value_of(std::string_view name, std::span<const Named<Enumeration>> table) {
  for (const auto& entry : table)
    if (entry.name == name) return entry.value;
  throw std::invalid_argument("unknown name: " + std::string(name));
}

}  // namespace bahnwerk
