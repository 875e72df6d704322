#include "server/http/endpoints.hpp"

#include <cstring>

namespace bahnwerk::server {
namespace asio = boost::asio;

std::optional<asio::ip::tcp::endpoint> tcp_endpoint(const asio::generic::stream_protocol::endpoint& any) {
  const int family = any.protocol().family();
  asio::ip::tcp::endpoint endpoint;
  if ((family != AF_INET && family != AF_INET6) || any.size() > endpoint.capacity()) return std::nullopt;
  std::memcpy(endpoint.data(), any.data(), any.size());
  endpoint.resize(any.size());
  return endpoint;
}

std::string peer_address(const asio::generic::stream_protocol::socket& socket) {
  boost::system::error_code error;
  const auto remote = socket.remote_endpoint(error);
  if (error) return {};
  const auto endpoint = tcp_endpoint(remote);
  return endpoint ? endpoint->address().to_string() : "unix";
}

std::string address_key(const std::string& text) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(text, error);
  if (error) return {};
  if (address.is_v4()) return address.to_string();
  const auto v6 = address.to_v6();
  if (v6.is_v4_mapped()) return asio::ip::make_address_v4(asio::ip::v4_mapped, v6).to_string();
  const auto bytes = v6.to_bytes();
  return {bytes.begin(), bytes.begin() + 8};
}

}  // namespace bahnwerk::server
