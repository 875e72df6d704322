#pragma once
/// Base64 encoding of bytes for JSON strings [RFC 4648, section 4].
#include <optional>
#include <string>
#include <string_view>

namespace bahnwerk::api {

/// Returns the encoded text, with padding.
std::string base64(std::string_view bytes);
/// Returns the decoded bytes, or none for invalid text. Line ends between characters and missing padding are accepted.
/// O(characters).
std::optional<std::string> from_base64(std::string_view text);

}  // namespace bahnwerk::api
