// Content negotiation of setpoints (RFC 9110, 12.5.1).
#include <algorithm>
#include <array>
#include <charconv>

#include "api/setpoints.hpp"

namespace bahnwerk::api {
namespace {

struct Offer {
  SetpointFormat format;
  std::string_view type, subtype;
};
/// In the server's order of preference.
constexpr std::array<Offer, 4> offers{{{SetpointFormat::json, "application", "json"},
                                       {SetpointFormat::csv, "text", "csv"},
                                       {SetpointFormat::ndjson, "application", "x-ndjson"},
                                       {SetpointFormat::f64, "application", "octet-stream"}}};

struct Range {
  std::string type, subtype;
  double quality = 1;
  int specificity() const { return type == "*" ? 0 : subtype == "*" ? 1 : 2; }
  bool matches(const Offer& offer) const {
    return (type == "*" || type == offer.type) && (subtype == "*" || subtype == offer.subtype);
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

/// Cuts the part before `separator` off the front of `text`.
std::string_view take(std::string_view& text, char separator) {
  const auto at = text.find(separator);
  const auto part = text.substr(0, at);
  text = at == text.npos ? std::string_view{} : text.substr(at + 1);
  return trim(part);
}

/// nullopt for what is no media range; such entries are ignored.
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

std::optional<SetpointFormat> negotiate_setpoints(std::string_view accept) {
  if (trim(accept).empty()) return SetpointFormat::json;
  std::vector<Range> ranges;
  while (!accept.empty())
    if (auto range = parse_range(take(accept, ','))) ranges.push_back(std::move(*range));

  std::optional<SetpointFormat> best;
  double best_quality = 0;
  int best_specificity = -1;
  for (const auto& offer : offers) {
    const Range* match = nullptr;  // the most specific range speaks for an offer
    for (const auto& range : ranges)
      if (range.matches(offer) && (!match || range.specificity() > match->specificity())) match = &range;
    if (!match || match->quality <= 0) continue;
    if (match->quality > best_quality || (match->quality == best_quality && match->specificity() > best_specificity)) {
      best = offer.format;
      best_quality = match->quality;
      best_specificity = match->specificity();
    }
  }
  return best;
}

std::string_view format_name(SetpointFormat format) {
  switch (format) {
    case SetpointFormat::csv:
      return "csv";
    case SetpointFormat::ndjson:
      return "ndjson";
    case SetpointFormat::f64:
      return "f64";
    case SetpointFormat::json:
      break;
  }
  return "json";
}

std::string_view content_type(SetpointFormat format) {
  switch (format) {
    case SetpointFormat::csv:
      return "text/csv; charset=utf-8; header=present";
    case SetpointFormat::ndjson:
      return "application/x-ndjson";
    case SetpointFormat::f64:
      return "application/octet-stream";
    case SetpointFormat::json:
      break;
  }
  return "application/json";
}

}  // namespace bahnwerk::api
