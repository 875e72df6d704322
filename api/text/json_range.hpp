#pragma once
/// Where a value stands in a JSON text.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

/// Bytes [begin, end) of a text.
struct TextRange {
  std::size_t begin = 0, end = 0;
};

/// Returns the bytes of the value at a path of member names, at least one, in a valid JSON document whose root is an
/// object; nullopt: there is none. Names match however they are escaped. Cost: 1 ns per byte.
std::optional<TextRange> value_range(std::string_view json, const std::vector<std::string>& path);

}  // namespace bahnwerk::api
