#pragma once
/// Documents of windings, and of the machines for them.
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "tests/api/documents.hpp"

namespace bahnwerk::api::winding_kind {

inline constexpr double degree = std::numbers::pi / 180;

inline nlohmann::json example(const std::string& name) {
  return test::read_json(test::source("schemas/examples/winding/" + name + ".json"));
}
inline nlohmann::json machine(const std::string& name) {
  return test::read_json(test::source("examples/machines/" + name + ".json"));
}

}  // namespace bahnwerk::api::winding_kind
