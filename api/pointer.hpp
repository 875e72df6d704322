#pragma once
/// JSON Pointers (RFC 6901).
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

/// Appends "/" and the token with "~" and "/" escaped.
void append_token(std::string& pointer, std::string_view token);
/// prefix + one token per place, e.g. ("/spec", {"contour", "points", "7"}) → "/spec/contour/points/7".
std::string pointer(std::string_view prefix, const std::vector<std::string>& place);
/// A user's text for use inside a message: in quotes, cut after 60 bytes at a character's boundary.
std::string in_quotes(std::string_view text);

}  // namespace bahnwerk::api
