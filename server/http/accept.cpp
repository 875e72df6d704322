#include "server/http/accept.hpp"

#include <algorithm>
#include <string>

#include "server/http/uri.hpp"

namespace bahnwerk::server {
namespace {

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// Removes the next part of `rest` up to `separator` and returns it.
std::string_view cut(std::string_view& rest, char separator) {
  const std::size_t at = rest.find(separator);
  const std::string_view part = rest.substr(0, at);
  rest = at == std::string_view::npos ? std::string_view() : rest.substr(at + 1);
  return trim(part);
}

}  // namespace

std::optional<Coding> content_coding(std::string_view content_encoding) {
  Coding coding = Coding::identity;
  while (!content_encoding.empty()) {
    const std::string name = lower(cut(content_encoding, ','));
    if (name.empty() || name == "identity") continue;
    if ((name != "gzip" && name != "x-gzip") || coding == Coding::gzip) return std::nullopt;
    coding = Coding::gzip;
  }
  return coding;
}

bool accepts_gzip(std::string_view accept_encoding) {
  bool any = false;
  while (!accept_encoding.empty()) {
    std::string_view item = cut(accept_encoding, ',');
    const std::string name = lower(cut(item, ';'));
    bool wanted = true;
    while (!item.empty()) {
      const std::string parameter = lower(cut(item, ';'));
      if (parameter.starts_with("q=")) wanted = parameter.find_first_of("123456789") != std::string::npos;
    }
    if (name == "gzip" || name == "x-gzip") return wanted;
    if (name == "*") any = wanted;
  }
  return any;
}

bool is_json(std::string_view content_type) {
  if (lower(cut(content_type, ';')) != "application/json") return false;
  while (!content_type.empty()) {
    const std::string parameter = lower(cut(content_type, ';'));
    if (parameter.starts_with("charset=") && parameter != "charset=utf-8" && parameter != "charset=\"utf-8\"")
      return false;
  }
  return true;
}

}  // namespace bahnwerk::server
