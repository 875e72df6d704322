#include "server/http/forwarded.hpp"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <charconv>
#include <stdexcept>

#include "server/http/uri.hpp"

namespace bahnwerk::server {
namespace {

namespace ip = boost::asio::ip;

/// Returns the bytes of an address, an IPv4 one's also in its IPv6 form; empty: it is none.
std::vector<unsigned char> bytes_of(const std::string& text) {
  boost::system::error_code error;
  const ip::address address = ip::make_address(text, error);
  if (error) return {};
  const auto list = [](const auto& bytes) { return std::vector<unsigned char>(bytes.begin(), bytes.end()); };
  if (address.is_v4()) return list(address.to_v4().to_bytes());
  const auto v6 = address.to_v6();
  return v6.is_v4_mapped() ? list(ip::make_address_v4(ip::v4_mapped, v6).to_bytes()) : list(v6.to_bytes());
}

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

/// Returns the last entry of a list with commas, and removes it from the list.
std::string last_entry(std::string& list) {
  const std::size_t comma = list.rfind(',');
  std::string last(trimmed(std::string_view(list).substr(comma == std::string::npos ? 0 : comma + 1)));
  list.resize(comma == std::string::npos ? 0 : comma);
  return last;
}

/// Returns an address without port and brackets; empty: it is none.
std::string address_in(const std::string& entry) {
  if (!bytes_of(entry).empty()) return entry;
  const std::string host = host_of(entry).value_or("");
  return bytes_of(host).empty() ? "" : host;
}

bool is_prefix(const std::string& text) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
  return text.starts_with('/') && text.size() <= 200 && text.find_first_not_of(letters) == std::string::npos &&
         text.find("//") == std::string::npos;
}

constexpr std::string_view forwarding[] = {"x-forwarded-for", "x-forwarded-proto", "x-forwarded-prefix", "forwarded"};

}  // namespace

TrustedProxies::TrustedProxies(const std::vector<std::string>& list) {
  for (const std::string& each : list) {
    if (each == "unix") {
      unix_ = true;
      continue;
    }
    const std::size_t slash = each.find('/');
    Network network{bytes_of(each.substr(0, slash)), 0};
    network.bits = static_cast<unsigned>(8 * network.bytes.size());
    bool good = !network.bytes.empty();
    if (slash != std::string::npos) {
      const char* const end = each.data() + each.size();
      unsigned bits = 0;
      const auto read = std::from_chars(each.data() + slash + 1, end, bits);
      good = good && read.ec == std::errc() && read.ptr == end && bits <= network.bits;
      network.bits = bits;
    }
    if (!good)
      throw std::runtime_error("'" + each + "' is no address of a proxy; expected for example 127.0.0.1 or 10.0.0.0/8");
    networks_.push_back(std::move(network));
  }
}

bool TrustedProxies::contain(const std::string& address) const {
  if (networks_.empty() && !unix_) return false;
  if (address == "unix") return unix_;
  const auto bytes = bytes_of(address);
  return std::any_of(networks_.begin(), networks_.end(), [&](const Network& network) {
    if (bytes.size() != network.bytes.size()) return false;
    for (unsigned bit = 0; bit < network.bits; bit += 8) {
      const unsigned left = std::min(8U, network.bits - bit), mask = 0xFFU << (8 - left) & 0xFFU;
      if (((bytes[bit / 8] ^ network.bytes[bit / 8]) & mask) != 0) return false;
    }
    return true;
  });
}

void apply_forwarded(const TrustedProxies& proxies, Request& request) {
  if (!proxies.contain(request.peer)) return;
  std::string clients = request.header("x-forwarded-for").value_or("");
  while (!clients.empty() && proxies.contain(request.peer)) {
    const std::string client = address_in(last_entry(clients));
    if (client.empty()) break;
    request.peer = client;
  }
  std::string schemes = request.header("x-forwarded-proto").value_or("");
  if (!schemes.empty()) request.secure = last_entry(schemes) == "https";
  std::string prefix = request.header("x-forwarded-prefix").value_or("");
  while (prefix.ends_with('/')) prefix.pop_back();
  if (is_prefix(prefix)) request.prefix = prefix;
  std::erase_if(request.headers, [](const auto& header) {
    return std::find(std::begin(forwarding), std::end(forwarding), header.first) != std::end(forwarding);
  });
}

bool from_this_machine(const Request& request) {
  const auto passed_on = [](const auto& header) {
    return header.first == "via" ||
           std::find(std::begin(forwarding), std::end(forwarding), header.first) != std::end(forwarding);
  };
  if (std::any_of(request.headers.begin(), request.headers.end(), passed_on)) return false;
  if (request.peer == "unix") return true;
  const auto bytes = bytes_of(request.peer);
  return bytes.size() == 4 ? bytes[0] == 127 : !bytes.empty() && request.peer == "::1";
}

}  // namespace bahnwerk::server
