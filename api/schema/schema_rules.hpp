#pragma once
/// A schema compiled for fast validation: tells whether a document is valid, without saying why it is not.
#include <memory>
#include <nlohmann/json_fwd.hpp>

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::api {

/// The rules of a schema that check_schema (schema_explain.hpp) accepts; immutable and thread-safe.
class SchemaRules {
 public:
  /// `schema` must outlive the rules, which refer to its constants.
  explicit SchemaRules(const nlohmann::json& schema);
  ~SchemaRules();
  SchemaRules(SchemaRules&&) noexcept;

  /// Tells whether the document is valid. Asks `progress` every few thousand values, as stage "read". Cost: linear in
  /// the document, about 0.02 µs per number.
  bool allow(const nlohmann::json& document, Progress& progress) const;

 private:
  struct Table;
  std::unique_ptr<Table> table_;
};

}  // namespace bahnwerk::api
