#include "server/callbacks/callback_hosts.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bahnwerk::server {
namespace {

TEST(CallbackHosts, WithoutAnyEveryCallbackIsRefusedWithTheFlagToGive) {
  EXPECT_NE(CallbackHosts().refusal("http://erp.example.com/done").find("--callback-host"), std::string::npos);
}

TEST(CallbackHosts, ListedHostsAloneAreCalledWhateverTheirCaseAndPort) {
  const CallbackHosts hosts({"erp.example.com", "10.0.0.5", "[::1]", "*.Plant.example"});
  for (const char* url : {"http://erp.example.com/done", "https://ERP.example.com:8443/", "http://10.0.0.5/a?b=c",
                          "http://[::1]:9/", "http://hall3.plant.example/x", "http://a.b.plant.example"})
    EXPECT_EQ(hosts.refusal(url), "") << url;
  for (const char* url : {"http://example.com/", "http://xerp.example.com/", "http://plant.example/",
                          "http://10.0.0.50/", "http://0x0a000005/", "http://erp.example.com.evil.example/",
                          "http://evil.example/?erp.example.com", "http://plant.example.evil/", "nonsense"})
    EXPECT_NE(hosts.refusal(url), "") << url;
}

TEST(CallbackHosts, PrivateAddressesAreReachedByHostsThatAreListedAsTheyAre) {
  const CallbackHosts hosts({"erp.example.com", "*.plant.example", "127.0.0.1"});
  EXPECT_TRUE(hosts.may_connect("http://erp.example.com/", "10.0.0.5"));
  EXPECT_TRUE(hosts.may_connect("http://127.0.0.1:8/", "127.0.0.1"));
  EXPECT_FALSE(hosts.may_connect("http://a.plant.example/", "10.0.0.5"));
  EXPECT_TRUE(hosts.may_connect("http://a.plant.example/", "8.8.8.8"));
  EXPECT_EQ(CallbackHosts({"*"}).refusal("http://anything.example/"), "");
  EXPECT_FALSE(CallbackHosts({"*"}).may_connect("http://localhost/", "127.0.0.1"));
}

TEST(CallbackHosts, AddressesOfMachinesAndNetworksOfTheirOwnAreNotPublic) {
  for (const char* address : {"0.0.0.0",
                              "10.255.0.1",
                              "100.64.0.1",
                              "127.8.8.8",
                              "169.254.169.254",
                              "172.31.255.255",
                              "192.168.1.1",
                              "198.19.0.1",
                              "224.0.0.1",
                              "255.255.255.255",
                              "::",
                              "::1",
                              "fe80::1",
                              "fe80::1%eth0",
                              "fc00::1",
                              "ff02::1",
                              "::ffff:10.0.0.1",
                              "2002:0a00:0001::",
                              "2001:0:1::",
                              "2001:db8::1",
                              "64:ff9b::a00:1",
                              "localhost",
                              ""})
    EXPECT_FALSE(is_public_address(address)) << address;
  for (const char* address : {"8.8.8.8", "172.32.0.1", "100.128.0.1", "2606:4700::1111", "::ffff:8.8.8.8"})
    EXPECT_TRUE(is_public_address(address)) << address;
}

TEST(CallbackHosts, RefusesWhatIsNoHost) {
  for (const char* host : {"", "http://a", "a:80", "a/b", "*a", "a b", "*."})
    EXPECT_THROW(CallbackHosts({host}), std::invalid_argument) << host;
}

TEST(CallbackHosts, AReceiverIsASchemeAHostAndAPort) {
  EXPECT_EQ(receiver_of("http://A.example/x?y"), "http://a.example:80");
  EXPECT_EQ(receiver_of("HTTPS://a.example"), "https://a.example:443");
  EXPECT_EQ(receiver_of("http://[::1]:81/"), "http://[::1]:81");
  EXPECT_EQ(receiver_of("nonsense"), "");
}

}  // namespace
}  // namespace bahnwerk::server
