#include "server/http/accept.hpp"

#include <gtest/gtest.h>

#include <array>

namespace bahnwerk::server {
namespace {

constexpr std::array<std::string_view, 2> offers{"text/html", "application/json"};
int choose(std::optional<std::string_view> accept) {
  const auto chosen = negotiate(accept, offers);
  return chosen ? static_cast<int>(*chosen) : -1;
}

TEST(Negotiate, FollowsRfc9110) {
  EXPECT_EQ(choose(std::nullopt), 0);
  EXPECT_EQ(choose(""), 0);
  EXPECT_EQ(choose("*/*"), 0);
  EXPECT_EQ(choose("application/json"), 1);
  EXPECT_EQ(choose("APPLICATION/JSON"), 1);
  EXPECT_EQ(choose("application/*"), 1);
  EXPECT_EQ(choose("application/json;q=0.5, text/html;q=0.4"), 1);
  EXPECT_EQ(choose("application/json, text/html"), 0);  // a tie: the server's order
  EXPECT_EQ(choose("text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8"), 0);
  EXPECT_EQ(choose("*/*;q=0.1, application/json;q=0"), 0);
  EXPECT_EQ(choose("*/*, text/html;q=0"), 1);  // the more specific range decides
  EXPECT_EQ(choose("image/png"), -1);
  EXPECT_EQ(choose("application/json;q=0"), -1);
  EXPECT_EQ(choose("application/json;q=nonsense"), -1);
  EXPECT_EQ(choose(";;;,,,"), -1);
  EXPECT_EQ(choose("application/json ; charset=utf-8 ; q=1"), 1);
}

TEST(ContentCoding, KnowsGzipAndIdentity) {
  for (const char* text : {"", "identity", "Identity", " identity , identity"})
    EXPECT_EQ(content_coding(text), Coding::identity) << text;
  for (const char* text : {"gzip", "GZIP", "x-gzip", "identity, gzip"})
    EXPECT_EQ(content_coding(text), Coding::gzip) << text;
  for (const char* text : {"br", "deflate", "gzip, gzip", "gzip, br", "zstd", "gzip;q=1"})
    EXPECT_FALSE(content_coding(text)) << text;
}

TEST(IsJson, TakesParameters) {
  EXPECT_TRUE(is_json("application/json"));
  EXPECT_TRUE(is_json("Application/JSON; charset=UTF-8"));
  EXPECT_TRUE(is_json("application/json;charset=\"utf-8\""));
  EXPECT_FALSE(is_json("application/json; charset=latin1"));
  EXPECT_FALSE(is_json("text/json"));
  EXPECT_FALSE(is_json("application/jsonx"));
  EXPECT_FALSE(is_json(""));
}

TEST(AcceptsGzip, FollowsNamesAndWeights) {
  for (const char* yes : {"gzip", "GZIP", "x-gzip", "br, gzip;q=0.5", "deflate;q=1, *;q=0.1", "gzip; q=1.0", "*"})
    EXPECT_TRUE(accepts_gzip(yes)) << yes;
  for (const char* no : {"", "identity", "br", "gzip;q=0", "gzip;q=0.000, *", "*;q=0", "gzipped"})
    EXPECT_FALSE(accepts_gzip(no)) << no;
}

}  // namespace
}  // namespace bahnwerk::server
