#include "server/callbacks/callback_hosts.hpp"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/network_v4.hpp>
#include <boost/url/parse.hpp>
#include <boost/url/url_view.hpp>
#include <stdexcept>

#include "server/http/uri.hpp"

namespace bahnwerk::server {
namespace {

namespace ip = boost::asio::ip;

bool is_public(const ip::address_v4& address) {
  static const std::vector<ip::network_v4> others = [] {
    std::vector<ip::network_v4> list;
    for (const char* net : {"0.0.0.0/8", "10.0.0.0/8", "100.64.0.0/10", "127.0.0.0/8", "169.254.0.0/16",
                            "172.16.0.0/12", "192.0.0.0/24", "192.0.2.0/24", "192.88.99.0/24", "192.168.0.0/16",
                            "198.18.0.0/15", "198.51.100.0/24", "203.0.113.0/24", "224.0.0.0/4", "240.0.0.0/4"})
      list.push_back(ip::make_network_v4(net));
    return list;
  }();
  return std::none_of(others.begin(), others.end(), [&](const ip::network_v4& net) {
    return net.prefix_length() == 32 ? net.network() == address
                                     : ip::network_v4(address, net.prefix_length()).network() == net.network();
  });
}

/// Of the IPv6 addresses only 2000::/3 is given out; translations of IPv4 addresses are as public as these.
bool is_public(const ip::address_v6& address) {
  const auto bytes = address.to_bytes();
  const auto v4 = [&](std::size_t at) {
    return ip::address_v4({bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]});
  };
  if (address.is_v4_mapped()) return is_public(v4(12));
  if ((bytes[0] & 0xE0) != 0x20) return false;
  if (bytes[0] == 0x20 && bytes[1] == 0x02) return is_public(v4(2));                       // 6to4
  if (bytes[0] == 0x20 && bytes[1] == 0x01 && bytes[2] < 2) return false;                  // Teredo and others
  return !(bytes[0] == 0x20 && bytes[1] == 0x01 && bytes[2] == 0x0d && bytes[3] == 0xb8);  // documentation
}

std::string host_in(const std::string& url) {
  const auto parsed = boost::urls::parse_uri(url);
  return parsed ? lower(parsed->host_address()) : "";
}

}  // namespace

bool is_public_address(const std::string& address) {
  boost::system::error_code error;
  const auto parsed = ip::make_address(address.substr(0, address.find('%')), error);
  if (error) return false;
  return parsed.is_v4() ? is_public(parsed.to_v4()) : is_public(parsed.to_v6());
}

CallbackHosts::CallbackHosts(const std::vector<std::string>& list) {
  for (const std::string& each : list) {
    const std::string text = lower(each);
    if (text == "*" || (text.starts_with("*.") && text.size() > 2)) {
      suffixes_.push_back(text.substr(1));
      continue;
    }
    const bool brackets = text.starts_with('[') && text.ends_with(']');
    const std::string host = brackets ? text.substr(1, text.size() - 2) : text;
    boost::system::error_code error;
    const bool v6 = ip::make_address(host, error).is_v6() && !error;
    if (host.empty() || host.find_first_of("/@*?# ") != std::string::npos ||
        (host.find(':') != std::string::npos && !v6))
      throw std::invalid_argument("--callback-host " + each +
                                  " is no host; expected a name or an address without port, *.NAME, or *");
    exact_.push_back(host);
  }
}

bool CallbackHosts::exact(std::string_view host) const {
  return std::find(exact_.begin(), exact_.end(), host) != exact_.end();
}

std::string CallbackHosts::refusal(const std::string& url) const {
  if (empty())
    return "this service calls no hosts: leave the callback out and wait with Prefer: wait, or have the service "
           "started with --callback-host HOST";
  const std::string host = host_in(url);
  if (host.empty()) return "is no address that can be called";
  const auto below = [&](const std::string& suffix) { return suffix.empty() || host.ends_with(suffix); };
  if (exact(host) || std::any_of(suffixes_.begin(), suffixes_.end(), below)) return "";
  return "this service does not call the host " + host + ": have it started with --callback-host " + host + ", too";
}

bool CallbackHosts::may_connect(const std::string& url, const std::string& address) const {
  return exact(host_in(url)) || is_public_address(address);
}

std::string receiver_of(const std::string& url) {
  const auto parsed = boost::urls::parse_uri(url);
  if (!parsed || parsed->host_address().empty()) return "";
  const std::string scheme = lower(parsed->scheme());
  const std::string port = parsed->has_port() ? std::string(parsed->port()) : scheme == "https" ? "443" : "80";
  return scheme + "://" + lower(parsed->encoded_host()) + ":" + port;
}

}  // namespace bahnwerk::server
