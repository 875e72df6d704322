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

TEST(ParseTarget, TakesTheAbsoluteForm) { EXPECT_EQ(parse_target("http://host:80/healthz?a=b")->path, "/healthz"); }

TEST(ParseTarget, RefusesWhatIsMalformed) {
  for (const char* target : {"", "*", "nothing", "/%zz", "/%4", "/a b", "http://host", "/?%G0"})
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

}  // namespace
}  // namespace bahnwerk::server
