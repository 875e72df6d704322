#include "api/schema/schema.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "api/schema/schema_explain.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

/// Removes what valijson must not see: its "format" runs std::regex over text of any length, which can exhaust the
/// stack.
void strip_format(json& schema) {
  if (schema.is_object() && schema.contains("format") && schema["format"].is_string()) schema.erase("format");
  for (auto& child : schema)
    if (child.is_structured()) strip_format(child);
}

}  // namespace

struct Schema::State {
  json document;
  valijson::Schema compiled;
};

Schema::Schema(std::string_view text) : state_(std::make_unique<State>()) {
  state_->document = json::parse(text);
  check_schema(state_->document);
  json stripped = state_->document;
  strip_format(stripped);
  valijson::adapters::NlohmannJsonAdapter adapter(stripped);
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(adapter, state_->compiled);
}
Schema::~Schema() = default;
Schema::Schema(Schema&&) noexcept = default;

std::vector<FieldError> Schema::validate(const json& document, std::string_view prefix) const {
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  const valijson::adapters::NlohmannJsonAdapter adapter(document);
  if (validator.validate(state_->compiled, adapter, nullptr)) return {};
  auto errors = explain(state_->document, document, prefix, max_faults);
  if (errors.empty()) errors.push_back({std::string(prefix), "does not follow the schema"});
  return errors;
}

}  // namespace bahnwerk::api
