#include "server/http/uri.hpp"

#include <boost/url/encode.hpp>
#include <boost/url/parse.hpp>
#include <boost/url/rfc/unreserved_chars.hpp>
#include <boost/url/url_view.hpp>

namespace bahnwerk::server {
namespace urls = boost::urls;

std::optional<Target> parse_target(std::string_view target) {
  if (target.starts_with("http://") || target.starts_with("https://")) {  // absolute form, as sent to proxies
    const std::size_t path = target.find_first_of("/?", target.find("//") + 2);
    if (path == std::string_view::npos || target[path] == '?') return std::nullopt;
    target = target.substr(path);
  }
  const auto parsed = urls::parse_origin_form(target);
  if (!parsed) return std::nullopt;
  const urls::url_view url = *parsed;
  Target result;
  result.path = url.path();
  for (const auto& segment : url.segments()) result.segments.push_back(segment);
  urls::encoding_opts options;
  options.space_as_plus = true;
  if (url.encoded_query().empty()) return result;  // "/path?" has no parameter, not one with an empty name
  for (const auto& pair : url.params(options)) result.query.emplace_back(pair.key, pair.value);
  return result;
}

std::string encode_component(std::string_view text) { return urls::encode(text, urls::unreserved_chars); }

}  // namespace bahnwerk::server
