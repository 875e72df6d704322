#include "server/http/etag.hpp"

#include "server/runtime/sha256.hpp"

namespace bahnwerk::server {

std::string etag_of(std::string_view bytes) { return "\"" + sha256(bytes).substr(0, 32) + "\""; }

bool names_etag(std::string_view rest, const std::string& etag, Comparison comparison) {
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    std::string_view item = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
    while (item.starts_with(' ')) item.remove_prefix(1);
    while (item.ends_with(' ')) item.remove_suffix(1);
    if (comparison == Comparison::weak && item.starts_with("W/")) item.remove_prefix(2);
    if (item == "*" || item == etag) return true;
  }
  return false;
}

bool matches_etag(const Request& request, const std::string& etag) {
  const auto given = request.header("if-none-match");
  return given && names_etag(*given, etag, Comparison::weak);
}

Response with_etag(const Request& request, const std::string& etag, Response response) {
  if (matches_etag(request, etag)) {
    response.status = 304;
    response.body.clear();
    response.stream = nullptr;
    response.length.reset();
    response.feed = nullptr;
  }
  response.set("ETag", etag);
  response.set("Cache-Control", "no-cache");
  return response;
}

}  // namespace bahnwerk::server
