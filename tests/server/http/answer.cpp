#include "server/http/answer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "server/store/store.hpp"

namespace bahnwerk::server {
namespace {

using nlohmann::json;

Request request_for(const std::string& target) {
  Request request;
  request.target = target;
  return request;
}

/// The answer to `error`, thrown by a handler.
template <class Error>
Response thrown(const Error& error) {
  Response answer;
  reply_with(
      request_for("/v1/jobs"), [&](Response response) { answer = std::move(response); },
      [&]() -> Response { throw error; });
  return answer;
}

TEST(Answer, AFaultOfTheMessageKeepsItsStatus) {
  for (const int status : {400, 408, 413, 417, 431, 501, 503, 505}) {
    const Response answer = http_error_answer(status, "why", "/here");
    EXPECT_EQ(answer.status, status);
    const json body = json::parse(answer.body);
    EXPECT_EQ(body["status"], status);
    EXPECT_EQ(body["detail"], "why");
    EXPECT_EQ(body["instance"], "/here");
    EXPECT_EQ(answer.header("Content-Type"), "application/problem+json");
    EXPECT_EQ(answer.header("Cache-Control"), "no-store");
  }
  EXPECT_EQ(http_error_answer(418, "why", "").status, 500) << "any other is the server's";
}

TEST(Answer, OnlyWhatPassesByItselfAsksToTryAgain) {
  EXPECT_EQ(http_error_answer(503, "", "").header("Retry-After"), "10");
  EXPECT_EQ(http_error_answer(400, "", "").header("Retry-After"), std::nullopt);
  EXPECT_EQ(thrown(api::Problem("too-many-jobs", "")).header("Retry-After"), "5");
}

TEST(Answer, MissingMemoryAsksToTryAgain) {
  const Response answer = thrown(std::bad_alloc());
  EXPECT_EQ(answer.status, 503);
  EXPECT_EQ(json::parse(answer.body)["type"], "/problems/out-of-memory");
  EXPECT_EQ(answer.header("Retry-After"), "10");
}

/// A text of pieces of 10 000 bytes.
struct Pieces final : StoredText {
  explicit Pieces(std::size_t n) : left(n), all(n) {}
  std::size_t size() const override { return 10'000 * all; }
  bool next(std::string& out) override {
    if (left == 0) return false;
    --left;
    out.append(10'000, 'x');
    return true;
  }
  std::size_t left, all;
};

TEST(Answer, AShortTextIsABodyALongOneAStreamOfKnownLength) {
  EXPECT_EQ(text_answer("text/plain", std::make_unique<Pieces>(1)).body.size(), 10'000U);
  const Response answer = text_answer("text/plain", std::make_unique<Pieces>(5));
  EXPECT_EQ(answer.length, 50'000U);
  std::string text;
  while (answer.stream(text)) {
  }
  EXPECT_EQ(text.size(), 50'000U);
}

TEST(Answer, AStoreThatIsAwayOrAStandbyIsUnavailableForNow) {
  for (const Response& answer : {thrown(StoreAway("server /secret")), thrown(StoreReadOnly("server /secret"))}) {
    EXPECT_EQ(answer.status, 503);
    EXPECT_EQ(json::parse(answer.body)["type"], "/problems/store-unavailable");
    EXPECT_EQ(answer.header("Retry-After"), "10");
    EXPECT_EQ(answer.body.find("secret"), std::string::npos);
  }
}

TEST(Answer, TextsOfUnknownExceptionsStayInside) {
  testing::internal::CaptureStderr();
  const Response unknown = thrown(std::runtime_error("password 1234")),
                 broken = thrown(StoreError("disk /secret", false)), full = thrown(StoreError("disk /secret", true));
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(unknown.status, 500);
  EXPECT_EQ(broken.status, 500);
  EXPECT_EQ(full.status, 507);
  for (const Response* answer : {&unknown, &broken, &full}) {
    EXPECT_EQ(answer->body.find("secret"), std::string::npos);
    EXPECT_EQ(answer->body.find("1234"), std::string::npos);
    EXPECT_EQ(json::parse(answer->body)["instance"], "/v1/jobs");
  }
  EXPECT_NE(log.find("password 1234"), std::string::npos) << "the log has them";
  EXPECT_NE(log.find("disk /secret"), std::string::npos);
}

TEST(Answer, TextThatIsNotUtf8StillMakesADocument) {
  const Response answer = json_answer(201, {{"name", "a\xff"}});
  EXPECT_EQ(answer.status, 201);
  EXPECT_EQ(answer.header("Content-Type"), "application/json");
  EXPECT_EQ(json::parse(answer.body)["name"], "a\xef\xbf\xbd");
}

TEST(Answer, ThereIsOneReplyWhetherWorkReturnsOrThrows) {
  int replies = 0;
  const Reply reply = [&](const Response&) { ++replies; };
  reply_with(request_for("/"), reply, [] { return text_answer(200, "text/plain", "ok"); });
  EXPECT_EQ(replies, 1);
  reply_with(request_for("/"), reply, []() -> Response { throw api::Problem("bad-request", "no"); });
  EXPECT_EQ(replies, 2);
}

}  // namespace
}  // namespace bahnwerk::server
