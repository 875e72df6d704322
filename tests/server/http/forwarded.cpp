#include "server/http/forwarded.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bahnwerk::server {
namespace {

Request from(const std::string& peer, Pairs headers) {
  Request request;
  request.peer = peer;
  request.headers = std::move(headers);
  return request;
}

TEST(TrustedProxies, AreAddressesNetworksAndTheUnixSocket) {
  const TrustedProxies proxies({"127.0.0.1", "10.1.0.0/15", "fd00::/8", "unix"});
  for (const char* address : {"127.0.0.1", "::ffff:127.0.0.1", "10.0.0.1", "10.1.255.255", "fd12::1", "unix"})
    EXPECT_TRUE(proxies.contain(address)) << address;
  for (const char* address : {"127.0.0.2", "10.2.0.0", "fe80::1", "", "x"}) EXPECT_FALSE(proxies.contain(address));
  EXPECT_FALSE(TrustedProxies().contain("unix"));
  for (const char* wrong : {"", "proxy", "10.0.0.0/33", "10.0.0.0/", "10.0.0.0/x"})
    EXPECT_THROW(TrustedProxies({wrong}), std::runtime_error) << wrong;
}

TEST(ApplyForwarded, TakesTheLastClientThatIsNoProxy) {
  const TrustedProxies proxies({"127.0.0.1", "10.0.0.0/8"});
  Request request = from("127.0.0.1", {{"x-forwarded-for", "1.1.1.1, 9.8.7.6:443, 10.0.0.3"},
                                       {"x-forwarded-proto", "https"},
                                       {"x-forwarded-prefix", "/plan/"},
                                       {"accept", "*/*"}});
  apply_forwarded(proxies, request);
  EXPECT_EQ(request.peer, "9.8.7.6");
  EXPECT_TRUE(request.secure);
  EXPECT_EQ(request.prefix, "/plan");
  EXPECT_EQ(request.headers.size(), 1U);
}

TEST(ApplyForwarded, BelievesNobodyElse) {
  Request request = from("9.9.9.9", {{"x-forwarded-for", "127.0.0.1"}, {"x-forwarded-prefix", "/plan"}});
  apply_forwarded(TrustedProxies({"127.0.0.1"}), request);
  EXPECT_EQ(request.peer, "9.9.9.9");
  EXPECT_EQ(request.prefix, "");
  EXPECT_FALSE(from_this_machine(request));
}

TEST(ApplyForwarded, PassesOverPrefixesThatAreNoPaths) {
  for (const char* prefix : {"plan", "//evil.example", "/a\"b", "/a?b"}) {
    Request request = from("127.0.0.1", {{"x-forwarded-prefix", prefix}});
    apply_forwarded(TrustedProxies({"127.0.0.1"}), request);
    EXPECT_EQ(request.prefix, "") << prefix;
  }
}

TEST(FromThisMachine, IsLoopbackWithoutAnUnknownProxy) {
  for (const char* peer : {"127.0.0.1", "127.1.2.3", "::1", "::ffff:127.0.0.1", "unix"})
    EXPECT_TRUE(from_this_machine(from(peer, {}))) << peer;
  EXPECT_FALSE(from_this_machine(from("192.168.0.1", {})));
  EXPECT_FALSE(from_this_machine(from("127.0.0.1", {{"x-forwarded-for", "1.2.3.4"}})));
  EXPECT_FALSE(from_this_machine(from("127.0.0.1", {{"via", "1.1 proxy"}})));
}

}  // namespace
}  // namespace bahnwerk::server
