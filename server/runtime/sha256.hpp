#pragma once
#include <string>
#include <string_view>

namespace bahnwerk::server {

/// Returns the SHA-256 of a text as 64 hexadecimal digits. Throws std::runtime_error if the library fails.
std::string sha256(std::string_view text);
/// Returns the HMAC-SHA-256 [RFC 2104] of a text in the same form.
std::string hmac_sha256(std::string_view key, std::string_view text);

}  // namespace bahnwerk::server
