#pragma once
/// RFC 3339 times of ms since 1970 UTC.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace bahnwerk::api {

std::string rfc3339(std::int64_t ms);  ///< returns "2026-01-31T12:00:00.123Z"
std::optional<std::int64_t> parse_rfc3339(std::string_view text);

}  // namespace bahnwerk::api
