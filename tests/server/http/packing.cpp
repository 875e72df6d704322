#include "server/http/packing.hpp"

#include <gtest/gtest.h>

#include "server/http/answer.hpp"
#include "server/http/gzip.hpp"

namespace bahnwerk::server {
namespace {

const std::string text(5000, 'x');

Response run(Pairs headers, const Response& inner, Request* seen = nullptr) {
  const auto request = std::make_shared<Request>();
  request->headers = std::move(headers);
  Response answer;
  const Handler handler = [&](const RequestPtr& asked, const Reply& reply) {
    if (seen) *seen = *asked;
    reply(inner);
  };
  pack_answers([](const std::function<void()>& work) { work(); })(handler)(
      request, [&](Response response) { answer = std::move(response); });
  return answer;
}

Response tagged(int status = 200) {
  Response response = text_answer(status, "text/csv", status == 304 ? "" : text);
  response.set("ETag", "\"7\"");
  response.set("Vary", "Accept");
  return response;
}

TEST(Packing, FollowsTheClientAndNamesTheRepresentation) {
  const Response packed = run({{"accept-encoding", "gzip"}}, tagged());
  EXPECT_EQ(packed.header("Content-Encoding"), "gzip");
  EXPECT_EQ(packed.header("ETag"), "\"7-gzip\"");
  EXPECT_EQ(packed.header("Vary"), "Accept, Accept-Encoding");
  EXPECT_EQ(gunzip(packed.body, 10'000), text);
  const Response plain = run({}, tagged());
  EXPECT_FALSE(plain.header("Content-Encoding"));
  EXPECT_EQ(plain.header("ETag"), "\"7\"");
  EXPECT_EQ(plain.header("Vary"), "Accept, Accept-Encoding");
  EXPECT_EQ(plain.body, text);
}

TEST(Packing, GoesWithStreams) {
  Response response = text_answer(200, "text/csv", "");
  response.stream = [n = 0](std::string& piece) mutable {
    piece += text;
    return ++n < 3;
  };
  Response packed = run({{"accept-encoding", "gzip"}}, response);
  std::string body;
  while (packed.stream(body)) {
  }
  EXPECT_EQ(gunzip(body, 100'000), text + text + text);
}

TEST(Packing, LeavesSmallAnswersAndEventsAsTheyAre) {
  EXPECT_FALSE(run({{"accept-encoding", "gzip"}}, text_answer(200, "text/plain", "short")).header("Content-Encoding"));
  Response events = text_answer(200, "text/event-stream", text);
  EXPECT_FALSE(run({{"accept-encoding", "gzip"}}, events).header("Content-Encoding"));
}

TEST(Packing, UnderstandsTheTagsThatItGave) {
  Request seen;
  const Response known = run({{"if-none-match", "\"7-gzip\""}, {"accept-encoding", "gzip"}}, tagged(304), &seen);
  EXPECT_EQ(seen.header("if-none-match"), "\"7\"");
  EXPECT_EQ(known.header("ETag"), "\"7-gzip\"");
  EXPECT_EQ(run({{"if-none-match", "\"7\""}, {"accept-encoding", "gzip"}}, tagged(304)).header("ETag"), "\"7\"");
}

}  // namespace
}  // namespace bahnwerk::server
