#include "server/http/uri.hpp"

#include <gtest/gtest.h>

#include <random>

namespace bahnwerk::server {
namespace {

TEST(ParseTarget, SplitsAndDecodes) {
  const auto target = parse_target("/v1/jobs/a%2Fb%20c?state=running&reference=caf%C3%A9+1&empty=&flag");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/v1/jobs/a/b c");
  EXPECT_EQ(target->segments, (std::vector<std::string>{"v1", "jobs", "a/b c"}));
  EXPECT_EQ(target->query, (Pairs{{"state", "running"}, {"reference", "café 1"}, {"empty", ""}, {"flag", ""}}));
}

TEST(ParseTarget, KnowsTheRootAndTrailingSlashes) {
  EXPECT_TRUE(parse_target("/")->segments.empty());
  EXPECT_EQ(parse_target("/v1/")->segments, (std::vector<std::string>{"v1", ""}));
  EXPECT_EQ(parse_target("//v1")->segments.size(), 2U);
}

TEST(ParseTarget, TakesTheAbsoluteForm) {
  EXPECT_EQ(parse_target("http://host:80/healthz?a=b")->path, "/healthz");
  EXPECT_EQ(parse_target("http://host:80/healthz?a=b")->authority, "host:80");
  EXPECT_EQ(parse_target("HTTPS://[::1]?a=b")->query, (Pairs{{"a", "b"}}));
  EXPECT_TRUE(parse_target("http://host")->segments.empty());
  EXPECT_EQ(parse_target("/healthz")->authority, "");
}

TEST(ParseTarget, TakesTheWholeServer) { EXPECT_EQ(parse_target("*")->path, "*"); }

TEST(HostOf, IsTheNameWithoutItsPort) {
  EXPECT_EQ(host_of("LocalHost:8080"), "localhost");
  EXPECT_EQ(host_of("127.0.0.1"), "127.0.0.1");
  EXPECT_EQ(host_of("[::1]:80"), "::1");
  EXPECT_EQ(host_of("10.0.0.1.example:"), "10.0.0.1.example");
  for (const char* authority :
       {"", ":80", "a b@c/..", "user@host", "host:x", "host:99999", "host/path", "a b", "[::1", "[::1]x", "[1]", "::1"})
    EXPECT_FALSE(host_of(authority)) << authority;
}

TEST(ParseTarget, RefusesWhatIsMalformed) {
  for (const char* target :
       {"", "**", "nothing", "/%zz", "/%4", "/a b", "http://", "http:///x", "http://a b/", "http://u@host/", "/?%G0"})
    EXPECT_FALSE(parse_target(target)) << target;
}

TEST(EncodeComponent, ComesBack) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (auto n = random() % 12; n > 0; --n) text += static_cast<char>(random());
    const auto target = parse_target("/x/" + encode_component(text) + "?k=" + encode_component(text));
    ASSERT_TRUE(target);
    EXPECT_EQ(target->segments.back(), text);
    EXPECT_EQ(target->query.front().second, text);
  }
}

TEST(Uri, LowerChangesAsciiLettersAlone) { EXPECT_EQ(lower("GZIP;Q=0.5 \xC3\x84"), "gzip;q=0.5 \xC3\x84"); }

}  // namespace
}  // namespace bahnwerk::server
