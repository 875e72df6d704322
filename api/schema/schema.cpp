#include "api/schema/schema.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "api/schema/schema_explain.hpp"
#include "api/schema/schema_rules.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api {

using nlohmann::json;

struct Schema::State {
  explicit State(std::string_view text) : document(json::parse(text)), rules((check_schema(document), document)) {}
  const json document;
  const SchemaRules rules;
};

Schema::Schema(std::string_view text) : state_(std::make_unique<State>(text)) {}
Schema::~Schema() = default;
Schema::Schema(Schema&&) noexcept = default;

std::vector<FieldError> Schema::validate(const json& document, std::string_view prefix, Progress& progress) const {
  if (state_->rules.allow(document, progress)) return {};
  auto errors = explain(state_->document, document, prefix, max_faults, progress);
  if (errors.empty()) errors.push_back({std::string(prefix), "does not follow the schema"});
  return errors;
}

std::vector<FieldError> Schema::validate(const json& document, std::string_view prefix) const {
  SilentProgress silent;
  return validate(document, prefix, silent);
}

}  // namespace bahnwerk::api
