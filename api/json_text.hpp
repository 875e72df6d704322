#pragma once
/// Strict reading of JSON text (RFC 8259).
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace bahnwerk::api {

inline constexpr std::size_t deepest_nesting = 64;

/// Reads one document. Throws Problem "invalid-json", with line and column in its detail, for anything but one complete
/// value: syntax errors, NaN and Infinity, numbers beyond double, invalid UTF-8, text behind the value, nesting deeper
/// than 64, duplicate keys (with their pointer). Integral numbers up to 2^53 become integers however they are written
/// (2.0, 2e0, -0.0), so that a document has one form.
nlohmann::json parse_json(std::string_view text);

}  // namespace bahnwerk::api
