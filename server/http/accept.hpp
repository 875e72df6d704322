#pragma once
/// Headers that tell what a body is, and what is asked for.
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "api/accept.hpp"

namespace bahnwerk::server {

using api::negotiate;

/// How a body is packed, from its Content-Encoding [RFC 9110, 8.4]; nullopt: in a way, or a chain of ways, that is not
/// supported.
enum class Coding { identity, gzip };
std::optional<Coding> content_coding(std::string_view content_encoding);

/// Whether a Content-Type header says application/json (any charset parameter must be utf-8).
bool is_json(std::string_view content_type);

}  // namespace bahnwerk::server
