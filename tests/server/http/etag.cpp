#include "server/http/etag.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

Request asking(const std::string& name, const std::string& value) {
  Request request;
  request.headers = {{name, value}};
  return request;
}

TEST(Etag, ATagIsFoundInAListWeakOrAsAStar) {
  for (const char* tags : {"\"5\"", "W/\"5\"", "\"4\", \"5\"", " \"4\" ,W/\"5\" ", "*"})
    EXPECT_TRUE(matches_etag(asking("if-none-match", tags), "\"5\"")) << tags;
  for (const char* tags : {"\"55\"", "5", "\"4\"", ""})
    EXPECT_FALSE(matches_etag(asking("if-none-match", tags), "\"5\"")) << tags;
  EXPECT_FALSE(matches_etag({}, "\"5\""));
}

TEST(Etag, WhatTheClientHasIsNotSentAgain) {
  Response full;
  full.body = "text";
  const Response same = with_etag(asking("if-none-match", "\"a\""), "\"a\"", full),
                 other = with_etag(asking("if-none-match", "\"b\""), "\"a\"", full);
  EXPECT_EQ(same.status, 304);
  EXPECT_EQ(same.body, "");
  EXPECT_EQ(same.header("ETag"), "\"a\"");
  EXPECT_EQ(other.status, 200);
  EXPECT_EQ(other.body, "text");
  EXPECT_EQ(other.header("ETag"), "\"a\"");
}

TEST(Etag, WhatTheClientHasIsNotMade) {
  bool made = false;
  const auto make = [&] {
    made = true;
    return Response();
  };
  EXPECT_EQ(unless_known(asking("if-none-match", "\"a\""), "\"a\"", make).status, 304);
  EXPECT_FALSE(made);
  EXPECT_EQ(unless_known(asking("if-none-match", "\"b\""), "\"a\"", make).status, 200);
  EXPECT_TRUE(made);
}

TEST(Etag, OtherBytesHaveAnotherTag) {
  EXPECT_EQ(etag_of("a"), etag_of("a"));
  EXPECT_NE(etag_of("a"), etag_of("b"));
  EXPECT_EQ(etag_of("").size(), 34U);
}

}  // namespace
}  // namespace bahnwerk::server
