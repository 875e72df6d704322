#pragma once
/// JSON Pointers [RFC 6901] to places in a document.
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

/// Appends "/" and the token with "~" and "/" escaped.
void append_token(std::string& pointer, std::string_view token);
/// Returns `prefix` and one token per element of `place`, e.g. ("/spec", {"contour", "points", "7"}) →
/// "/spec/contour/points/7".
std::string pointer(std::string_view prefix, const std::vector<std::string>& place);
/// Returns a user's text in quotes for use inside a message, cut after 60 bytes at the boundary of a character.
std::string in_quotes(std::string_view text);

}  // namespace bahnwerk::api
