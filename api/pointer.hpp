#pragma once
/// JSON Pointers [RFC 6901] to places in a document.
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

/// Appends "/" and the token with "~" and "/" escaped; of a name longer than 500 bytes its begin and "…".
void append_token(std::string& pointer, std::string_view token);
/// Returns `prefix` and one token per element of `place`, e.g. ("/spec", {"contour", "points", "7"}) →
/// "/spec/contour/points/7".
std::string pointer(std::string_view prefix, const std::vector<std::string>& place);
/// Returns a user's text for use inside a message: cut after that many bytes, at the boundary of a character, with "…".
std::string shortened(std::string_view text, std::size_t longest = 60);
/// Returns a user's text, shortened, in quotes.
std::string in_quotes(std::string_view text);

}  // namespace bahnwerk::api
