#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.hpp"

namespace bahnwerk::server {

/// A request target in origin form, taken apart and decoded [RFC 3986; `+` in the query is a blank, as forms send it].
struct Target {
  std::string path;
  std::vector<std::string> segments;
  Pairs query;
};
std::optional<Target> parse_target(
    std::string_view target);  ///< nullopt: malformed (bad percent codes, no leading slash)

std::string encode_component(std::string_view text);  ///< percent-encodes all but unreserved characters

}  // namespace bahnwerk::server
