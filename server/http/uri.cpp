#include "server/http/uri.hpp"

#include <algorithm>
#include <boost/url/encode.hpp>
#include <boost/url/ipv6_address.hpp>
#include <boost/url/parse.hpp>
#include <boost/url/rfc/unreserved_chars.hpp>
#include <boost/url/url_view.hpp>
#include <charconv>

namespace bahnwerk::server {
namespace urls = boost::urls;

namespace {}  // namespace

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::optional<std::string> host_of(std::string_view authority) {
  std::string_view host, port;
  if (authority.starts_with('[')) {
    const std::size_t end = authority.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    host = authority.substr(1, end - 1);
    port = authority.substr(end + 1);
    if (!urls::parse_ipv6_address(host)) return std::nullopt;
  } else {
    host = authority.substr(0, authority.find(':'));
    port = authority.substr(host.size());
    constexpr std::string_view letters =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~!$&'()*+,;=%";
    if (host.empty() || host.find_first_not_of(letters) != std::string_view::npos) return std::nullopt;
  }
  if (port.empty() || port == ":") return lower(host);
  unsigned number = 0;
  const char* const end = port.data() + port.size();
  const auto [rest, error] = std::from_chars(port.data() + 1, end, number);
  if (port[0] != ':' || error != std::errc() || rest != end || number > 65535) return std::nullopt;
  return lower(host);
}

std::optional<Target> parse_target(std::string_view target) {
  Target result;
  result.path = "*";
  if (target == "*") return result;
  std::string with_path;
  const std::string scheme = lower(target.substr(0, 8));
  if (scheme.starts_with("http://") || scheme == "https://") {  // absolute form, as sent to proxies
    target = target.substr(target.find("//") + 2);
    const std::size_t path = std::min(target.find_first_of("/?"), target.size());
    result.authority = target.substr(0, path);
    if (!host_of(result.authority)) return std::nullopt;
    target = target.substr(path);
    if (!target.starts_with('/')) target = with_path.append("/").append(target);
  }
  const auto parsed = urls::parse_origin_form(target);
  if (!parsed) return std::nullopt;
  const urls::url_view url = *parsed;
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
