#include "api/pointer.hpp"

namespace bahnwerk::api {
namespace {

constexpr std::size_t longest_token = 500;  // bytes of a member's name; an answer must not repeat megabytes of it

}  // namespace

void append_token(std::string& pointer, std::string_view token) {
  pointer += '/';
  for (char c : shortened(token, longest_token)) {
    if (c == '~')
      pointer += "~0";
    else if (c == '/')
      pointer += "~1";
    else
      pointer += c;
  }
}

std::string pointer(std::string_view prefix, const std::vector<std::string>& place) {
  std::string text(prefix);
  for (const auto& token : place) append_token(text, token);
  return text;
}

std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return std::string(text.substr(0, end)) + "…";
}

std::string in_quotes(std::string_view text) { return '"' + shortened(text) + '"'; }

}  // namespace bahnwerk::api
