#pragma once
/// Why a document breaks its schema, in words and with pointers.
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "api/problem.hpp"

namespace bahnwerk::api {

/// Throws std::invalid_argument for a keyword that explain() does not know or a $ref that leads nowhere.
void check_schema(const nlohmann::json& schema);

/// What a local "$ref" ("#/$defs/…") stands for; other nodes stand for themselves. Throws std::invalid_argument for any
/// other reference.
const nlohmann::json& resolve_ref(const nlohmann::json& root, const nlohmann::json& node);

/// Every fault of `document`, at most `most`, one per place. Beside the standard keywords it reads "x-not-available", a
/// list of values or member names that a later version will take: they are invalid, only the message differs. "format"
/// is an annotation.
std::vector<FieldError> explain(const nlohmann::json& schema, const nlohmann::json& document, std::string_view prefix,
                                std::size_t most);

}  // namespace bahnwerk::api
