#pragma once
/// Validation of documents by JSON Schema. The supported keywords are those on which draft 7 and 2020-12 agree; a
/// schema with another keyword is refused when it is loaded, so that no rule is ignored.
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "api/problem.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api {

/// A compiled schema, immutable and thread-safe. Its rules decide validity; explain() (schema_explain.hpp) writes the
/// messages, which takes thirty times as long.
class Schema {
 public:
  /// Throws std::invalid_argument for a schema that uses an unknown keyword or a $ref that leads nowhere.
  explicit Schema(std::string_view text);
  ~Schema();
  Schema(Schema&&) noexcept;

  /// Returns the faults, at most `max_faults`, one per place, each at `prefix` + the pointer to the deepest faulty
  /// member; a missing member is named by the pointer that it would have. An empty list means that the document is
  /// valid. Asks `progress` every few thousand values, as stage "read". Cost: linear in the document.
  std::vector<FieldError> validate(const nlohmann::json& document, std::string_view prefix, Progress progress) const;
  std::vector<FieldError> validate(const nlohmann::json& document, std::string_view prefix = {}) const;
  static constexpr std::size_t max_faults = 50;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bahnwerk::api
