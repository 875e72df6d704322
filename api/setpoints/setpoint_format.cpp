// The formats of setpoints and their media types.
#include <array>
#include <string_view>

#include "api/setpoints/setpoints.hpp"
#include "api/text/accept.hpp"

namespace bahnwerk::api {

std::optional<SetpointFormat> negotiate_setpoints(std::string_view accept) {
  /// The formats in the server's order of preference.
  static constexpr std::array formats{SetpointFormat::json, SetpointFormat::csv, SetpointFormat::ndjson,
                                      SetpointFormat::f64};
  static constexpr std::array<std::string_view, formats.size()> types{
      "application/json", "text/csv", "application/x-ndjson", "application/octet-stream"};
  const auto chosen = negotiate(accept, types);
  return chosen ? std::optional(formats[*chosen]) : std::nullopt;
}

std::string_view format_name(SetpointFormat format) {
  switch (format) {
    case SetpointFormat::csv:
      return "csv";
    case SetpointFormat::ndjson:
      return "ndjson";
    case SetpointFormat::f64:
      return "f64";
    case SetpointFormat::f32:
      return "f32";
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
    case SetpointFormat::f32:
      return "application/octet-stream";
    case SetpointFormat::json:
      break;
  }
  return "application/json";
}

}  // namespace bahnwerk::api
