#pragma once
/// Headers that describe a body and the requested form of the answer.
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "api/text/accept.hpp"

namespace bahnwerk::server {

using api::negotiate;

/// Returns the coding of a body from its Content-Encoding [RFC 9110, 8.4]; nullopt for a coding, or a chain of codings,
/// that is not supported.
enum class Coding { identity, gzip };
std::optional<Coding> content_coding(std::string_view content_encoding);

/// Tells whether an answer may be packed with gzip, from Accept-Encoding [RFC 9110, 12.5.3].
bool accepts_gzip(std::string_view accept_encoding);

/// Tells whether a Content-Type header is application/json (any charset parameter must be utf-8).
bool is_json(std::string_view content_type);

}  // namespace bahnwerk::server
