#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace bahnwerk::server {

/// The text of a gzip body (RFC 1952, members one after the other included); nullopt when it would have more than
/// `most` bytes: a few kilobytes can stand for gigabytes, so unpacking stops there. Memory: the text, 64 KiB besides.
/// Throws Problem bad-request when it is damaged, or anything follows it.
std::optional<std::string> gunzip(std::string_view packed, std::size_t most);

}  // namespace bahnwerk::server
