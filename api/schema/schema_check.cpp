// Checks that a schema uses only supported keywords.
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "api/schema/schema_explain.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 9> annotations{
    "$schema", "$id", "$comment", "title", "description", "default", "examples", "format", "x-not-available"};
constexpr std::array<std::string_view, 14> plain{
    "type",      "enum",      "const",    "minimum",  "maximum",       "exclusiveMinimum", "exclusiveMaximum",
    "minLength", "maxLength", "minItems", "maxItems", "minProperties", "maxProperties",    "required"};

template <class List>
bool contains(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

void check_node(const json& root, const json& schema) {
  if (schema.is_boolean()) return;
  resolve_ref(root, schema);
  for (const auto& [key, value] : schema.items()) {
    if (key == "properties" || key == "$defs") {
      for (const auto& member : value) check_node(root, member);
    } else if (key == "oneOf") {
      for (const auto& branch : value) check_node(root, branch);
    } else if (key == "items" || key == "additionalProperties") {
      check_node(root, value);
    } else if (key != "$ref" && !contains(annotations, key) && !contains(plain, key)) {
      throw std::invalid_argument("schema: unknown keyword " + key);
    }
  }
}

}  // namespace

const json& resolve_ref(const json& root, const json& schema) {
  if (!schema.is_object() || !schema.contains("$ref")) return schema;
  const auto& ref = schema["$ref"].get_ref<const std::string&>();
  if (!ref.starts_with("#/")) throw std::invalid_argument("schema: $ref " + ref + " is not local");
  const json::json_pointer target(ref.substr(1));
  if (!root.contains(target)) throw std::invalid_argument("schema: $ref " + ref + " leads nowhere");
  return root.at(target);
}

void check_schema(const json& schema) { check_node(schema, schema); }

}  // namespace bahnwerk::api
