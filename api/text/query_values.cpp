#include "api/text/query_values.hpp"

#include <charconv>
#include <cmath>

#include "api/pointer.hpp"
#include "api/problem.hpp"

namespace bahnwerk::api {
namespace {

template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<std::size_t> natural(std::string_view text) { return number<std::size_t>(text); }

std::optional<double> real(std::string_view text) {
  const auto value = number<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == text.npos) return parts;
    text.remove_prefix(end + 1);
  }
}

void refuse_parameter(const std::string& parameter, const std::string& message) {
  throw Problem("schema-violation", message, {{pointer("/query", {parameter}), message}});
}

}  // namespace bahnwerk::api
