#pragma once
/// Decompression of request bodies.
#include <optional>
#include <string>
#include <string_view>

namespace bahnwerk::server {

/// Returns the text of a gzip body (RFC 1952, consecutive members included); nullopt if it has more than `most` bytes:
/// a few kilobytes may expand to gigabytes, so unpacking stops there. Memory: the text and 64 KiB. Throws Problem
/// bad-request for a damaged body, or data behind it.
std::optional<std::string> gunzip(std::string_view packed, std::size_t most);

}  // namespace bahnwerk::server
