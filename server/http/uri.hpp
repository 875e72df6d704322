#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.hpp"

namespace bahnwerk::server {

/// A request target, taken apart and decoded [RFC 9112, 3.2; RFC 3986; `+` in the query is a blank, as forms send it].
struct Target {
  std::string authority;  ///< HOST[:PORT] of the absolute form; empty in the others
  std::string path;       ///< "*" for the whole server
  std::vector<std::string> segments;
  Pairs query;
};
std::optional<Target> parse_target(
    std::string_view target);  ///< nullopt: malformed (bad percent codes, no leading slash)

/// Returns the host of HOST[:PORT] in lower case, an IPv6 address without brackets; nullopt: malformed, or none.
std::optional<std::string> host_of(std::string_view authority);

std::string lower(std::string_view text);             ///< returns the text with its ASCII letters in lower case
std::string encode_component(std::string_view text);  ///< percent-encodes all but unreserved characters

}  // namespace bahnwerk::server
