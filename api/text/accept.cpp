#include "api/text/accept.hpp"

#include <charconv>
#include <string>
#include <utility>
#include <vector>

namespace bahnwerk::api {
namespace {

struct Range {
  std::string type, subtype;
  double quality = 1;
  int specificity() const { return type == "*" ? 0 : subtype == "*" ? 1 : 2; }
  bool matches(std::string_view offer) const {
    const auto slash = offer.find('/');
    return (type == "*" || type == offer.substr(0, slash)) && (subtype == "*" || subtype == offer.substr(slash + 1));
  }
};

std::string_view trim(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// Removes the part before `separator` from the front of `text` and returns it.
std::string_view take(std::string_view& text, char separator) {
  const auto at = text.find(separator);
  const auto part = text.substr(0, at);
  text = at == text.npos ? std::string_view{} : text.substr(at + 1);
  return trim(part);
}

/// Parses a media range; nullopt for entries that are none, which are ignored.
std::optional<Range> parse_range(std::string_view entry) {
  const auto name = take(entry, ';');
  const auto slash = name.find('/');
  if (slash == name.npos) return std::nullopt;
  Range range{lower(name.substr(0, slash)), lower(name.substr(slash + 1))};
  if (range.type.empty() || range.subtype.empty() || (range.type == "*" && range.subtype != "*")) return std::nullopt;
  while (!entry.empty()) {
    auto parameter = take(entry, ';');
    const auto key = take(parameter, '=');
    if (lower(key) != "q") continue;
    const auto [end, error] = std::from_chars(parameter.data(), parameter.data() + parameter.size(), range.quality);
    if (error != std::errc{} || end != parameter.data() + parameter.size() ||
        !(range.quality >= 0 && range.quality <= 1))
      return std::nullopt;
  }
  return range;
}

}  // namespace

std::optional<std::size_t> negotiate(std::optional<std::string_view> accept, std::span<const std::string_view> offers) {
  if (!accept || trim(*accept).empty()) return 0;
  std::vector<Range> ranges;
  while (!accept->empty())
    if (auto range = parse_range(take(*accept, ','))) ranges.push_back(std::move(*range));

  std::optional<std::size_t> best;
  double best_quality = 0;
  int best_specificity = -1;
  for (std::size_t i = 0; i < offers.size(); ++i) {
    const Range* match = nullptr;  // the most specific range speaks for an offer
    for (const auto& range : ranges)
      if (range.matches(offers[i]) && (!match || range.specificity() > match->specificity())) match = &range;
    if (!match || match->quality <= 0) continue;
    if (match->quality > best_quality || (match->quality == best_quality && match->specificity() > best_specificity)) {
      best = i;
      best_quality = match->quality;
      best_specificity = match->specificity();
    }
  }
  return best;
}

}  // namespace bahnwerk::api
