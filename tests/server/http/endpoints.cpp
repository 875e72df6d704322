#include "server/http/endpoints.hpp"

#include <gtest/gtest.h>

#include <boost/asio/local/stream_protocol.hpp>

namespace bahnwerk::server {
namespace {

TEST(Endpoints, TcpEndpointsComeThroughGenericOnes) {
  for (const char* address : {"127.0.0.1", "::1"}) {
    const boost::asio::ip::tcp::endpoint endpoint(boost::asio::ip::make_address(address), 8080);
    EXPECT_EQ(tcp_endpoint(endpoint), endpoint);
  }
  EXPECT_EQ(tcp_endpoint(boost::asio::local::stream_protocol::endpoint("/tmp/x")), std::nullopt);
}

TEST(Endpoints, OneAddressIsAnIpv4AddressOrAnIpv6Network) {
  EXPECT_EQ(address_key("10.0.0.1"), "10.0.0.1");
  EXPECT_EQ(address_key("::ffff:10.0.0.1"), "10.0.0.1");
  EXPECT_EQ(address_key("fd00::1:2:3:4"), address_key("fd00::9"));
  EXPECT_NE(address_key("fd00::1"), address_key("fd01::1"));
  EXPECT_EQ(address_key("unix"), "");
}

}  // namespace
}  // namespace bahnwerk::server
