#include "server/http/accept.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string>

namespace bahnwerk::server {
namespace {

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// Cuts the next part off `rest` at `separator`.
std::string_view cut(std::string_view& rest, char separator) {
  const std::size_t at = rest.find(separator);
  const std::string_view part = rest.substr(0, at);
  rest = at == std::string_view::npos ? std::string_view() : rest.substr(at + 1);
  return trim(part);
}

/// 0 = no match, else the more the more specific.
int match(std::string_view range, std::string_view type) {
  if (range == type) return 3;
  if (range == "*/*") return 1;
  return range.ends_with("/*") && type.starts_with(range.substr(0, range.size() - 1)) ? 2 : 0;
}

}  // namespace

std::optional<std::size_t> negotiate(std::optional<std::string_view> accept, std::span<const std::string_view> offers) {
  if (!accept || trim(*accept).empty()) return 0;
  std::optional<std::size_t> best;
  double best_q = 0;
  for (std::size_t i = 0; i < offers.size(); ++i) {
    int specific = 0;
    double quality = 0;
    std::string_view rest = *accept;
    while (!rest.empty()) {
      std::string_view item = cut(rest, ',');
      const std::string range = lower(cut(item, ';'));
      double q = 1;
      while (!item.empty()) {
        const std::string parameter = lower(cut(item, ';'));
        if (parameter.starts_with("q=") &&
            std::from_chars(parameter.data() + 2, parameter.data() + parameter.size(), q).ec != std::errc())
          q = 0;
      }
      if (const int found = match(range, offers[i]); found > specific) {
        specific = found;
        quality = q;
      }
    }
    if (quality > best_q) {
      best = i;
      best_q = quality;
    }
  }
  return best;
}

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
