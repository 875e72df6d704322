#pragma once
/// Tags of answers, and requests that name one [RFC 9110, 8.8.3 and 13.1].
#include <string>
#include <string_view>

#include "server/http/message.hpp"

namespace bahnwerk::server {

/// Returns the tag, quotes included, of an answer with these bytes.
std::string etag_of(std::string_view bytes);
enum class Comparison { strong, weak };
/// Tells whether a list of tags contains `etag` or is "*"; a weak one counts only where the comparison is weak.
bool names_etag(std::string_view tags, const std::string& etag, Comparison comparison);
bool matches_etag(const Request& request, const std::string& etag);  ///< tells whether If-None-Match names the tag
/// Answers 304 when If-None-Match names `etag`, else `response` with it.
Response with_etag(const Request& request, const std::string& etag, Response response);
/// Answers 304 when If-None-Match names `etag`, else what `make` returns, with the tag.
template <class Make>
Response unless_known(const Request& request, const std::string& etag, Make&& make) {
  return with_etag(request, etag, matches_etag(request, etag) ? Response() : make());
}

}  // namespace bahnwerk::server
