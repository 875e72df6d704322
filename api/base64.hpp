#pragma once
/// Bytes in a JSON string: base64 [RFC 4648, section 4].
#include <optional>
#include <string>
#include <string_view>

namespace bahnwerk::api {

std::string base64(std::string_view bytes);
/// Line ends between the characters and missing padding are accepted. None for anything else. O(characters).
std::optional<std::string> from_base64(std::string_view text);

}  // namespace bahnwerk::api
