#pragma once
/// Values of a query string, and their refusal.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

/// Returns the number that the whole text is; nullopt if it is none.
std::optional<std::size_t> natural(std::string_view text);
std::optional<double> real(std::string_view text);  ///< finite
/// Returns the parts between separators; an empty text is one empty part.
std::vector<std::string> split(std::string_view text, char separator = ',');

/// Throws Problem schema-violation whose only error is at /query/<parameter>.
[[noreturn]] void refuse_parameter(const std::string& parameter, const std::string& message);

}  // namespace bahnwerk::api
