#pragma once
/// Messages, with pointers, on why a document violates its schema.
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "api/problem.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api {

/// Throws std::invalid_argument for a keyword that explain() does not know or a $ref that leads nowhere.
void check_schema(const nlohmann::json& schema);

/// Returns the node that a local "$ref" ("#/$defs/…") refers to; other nodes are returned themselves. Throws
/// std::invalid_argument for any other reference.
const nlohmann::json& resolve_ref(const nlohmann::json& root, const nlohmann::json& node);

/// Returns the faults of `document`, at most `most`, one per place. In addition to the standard keywords it reads
/// "x-not-available", a list of values or member names that a later version will accept: they are invalid with a
/// message of their own. "format" is an annotation. Asks `progress` every few thousand values, as stage "read".
std::vector<FieldError> explain(const nlohmann::json& schema, const nlohmann::json& document, std::string_view prefix,
                                std::size_t most, Progress progress);

}  // namespace bahnwerk::api
