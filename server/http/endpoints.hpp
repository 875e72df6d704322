#pragma once
/// Addresses of sockets of any family. Only the listener and its connections include this.
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <optional>
#include <string>

namespace bahnwerk::server {

/// Returns the TCP endpoint in a generic one; nullopt: it is of another family.
std::optional<boost::asio::ip::tcp::endpoint> tcp_endpoint(const boost::asio::generic::stream_protocol::endpoint& any);

/// Returns the client's address; "unix" for a Unix socket, "" if the client has left.
std::string peer_address(const boost::asio::generic::stream_protocol::socket& socket);

/// Returns the unit of the limit per address: an IPv4 address, or the /64 that belongs to one IPv6 customer; "" for
/// those without a limit.
std::string address_key(const std::string& address);

}  // namespace bahnwerk::server
