#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace bahnwerk::server {

/// Which of the offered media types an Accept header prefers [RFC 9110, 12.5.1]: the highest q wins, the most specific
/// range decides each type's q, ties go to the earlier offer. Absent header = the first offer; nullopt = nothing
/// acceptable.
std::optional<std::size_t> negotiate(std::optional<std::string_view> accept, std::span<const std::string_view> offers);

/// How a body is packed, from its Content-Encoding [RFC 9110, 8.4]; nullopt: in a way, or a chain of ways, that is not
/// supported.
enum class Coding { identity, gzip };
std::optional<Coding> content_coding(std::string_view content_encoding);

/// Whether a Content-Type header says application/json (any charset parameter must be utf-8).
bool is_json(std::string_view content_type);

}  // namespace bahnwerk::server
