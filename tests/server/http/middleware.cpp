#include "server/http/middleware.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/http/answer.hpp"

namespace bahnwerk::server {
namespace {

const Handler ok = [](const RequestPtr&, const Reply& reply) { reply(text_answer(200, "text/plain", "four")); };

Response run(const Middleware& middleware, const RequestPtr& request, const Handler& inner = ok) {
  Response answer;
  middleware(inner)(request, [&](Response response) { answer = std::move(response); });
  return answer;
}

TEST(Middleware, AUsableIdOfTheClientIsKeptAnyOtherIsReplaced) {
  for (const auto& [id, kept] : std::vector<std::pair<std::string, bool>>{{"a-1", true},
                                                                          {std::string(128, 'x'), true},
                                                                          {std::string(129, 'x'), false},
                                                                          {"", false},
                                                                          {"a b", false},
                                                                          {"a\nb", false},
                                                                          {"\xc3\xa4", false}}) {
    const auto request = std::make_shared<Request>();
    request->headers = {{"x-request-id", id}};
    const Response answer = run(request_id(), request);
    EXPECT_EQ(request->id == id, kept) << id;
    EXPECT_FALSE(request->id.empty());
    EXPECT_EQ(answer.header("X-Request-Id"), request->id);
  }
  const auto first = std::make_shared<Request>(), second = std::make_shared<Request>();
  run(request_id(), first), run(request_id(), second);
  EXPECT_NE(first->id, second->id);
}

TEST(Middleware, AnswersSayThatTheStoreCanOnlyBeRead) {
  StoreState state = StoreState::up;
  const auto header = [&] {
    return run(tell_store_state([&] { return state; }), std::make_shared<Request>()).header("Bahnwerk-Store");
  };
  EXPECT_FALSE(header());
  state = StoreState::read_only;
  EXPECT_EQ(header(), "read-only");
  state = StoreState::away;
  EXPECT_FALSE(header());
}

TEST(Middleware, ABrokenMessageIsAnsweredWithoutTheHandler) {
  const auto request = std::make_shared<Request>();
  request->fault = Fault{413, "too large"};
  bool called = false;
  const Response answer = run(guard(), request, [&](const RequestPtr&, const Reply&) { called = true; });
  EXPECT_FALSE(called);
  EXPECT_EQ(answer.status, 413);
  EXPECT_EQ(run(guard(), std::make_shared<Request>(),
                [](const RequestPtr&, const Reply&) { throw api::Problem("not-found", "no such job"); })
                .status,
            404);
}

TEST(Middleware, ClientsCannotInventLabelsOfMetrics) {
  Metrics metrics;
  const auto request = std::make_shared<Request>();
  request->method = "FROBNICATE";
  request->path = "/secret";
  run(count(metrics), request);
  request->method = "GET", request->route = "/v1/jobs/{id}";
  run(count(metrics), request);
  const std::string text = metrics.text();
  EXPECT_EQ(text.find("FROBNICATE"), std::string::npos);
  EXPECT_EQ(text.find("secret"), std::string::npos);
  EXPECT_NE(text.find("unmatched"), std::string::npos);
  EXPECT_NE(text.find("/v1/jobs/{id}"), std::string::npos);
}

TEST(Middleware, TheLogHasOneLinePerRequest) {
  const auto request = std::make_shared<Request>();
  request->method = "GET", request->route = "/a", request->path = std::string(600, 'p'), request->id = "7";
  testing::internal::CaptureStderr();
  run(access_log(LoggedRequests::all), request);
  const auto line = nlohmann::json::parse(testing::internal::GetCapturedStderr());
  EXPECT_EQ(line["request"], "7");
  EXPECT_EQ(line["status"], 200);
  EXPECT_EQ(line["bytes"], 4);
  EXPECT_EQ(line["path"].get<std::string>().size(), 500u) << "a long path is cut";
}

TEST(Middleware, TheLogNamesTheJobThatARequestIsAboutOrHasMade) {
  const auto line = [](const RequestPtr& request, const Handler& handler) {
    testing::internal::CaptureStderr();
    run(access_log(LoggedRequests::all), request, handler);
    return nlohmann::json::parse(testing::internal::GetCapturedStderr());
  };
  const auto post = std::make_shared<Request>();
  post->headers = {{"traceparent", "00-ab-cd-01"}};
  const auto posted = line(post, [](const RequestPtr&, const Reply& reply) {
    Response response = text_answer(202, "text/plain", "");
    response.set("Location", "/v1/jobs/abc");
    reply(response);
  });
  EXPECT_EQ(posted["job"], "abc");
  EXPECT_EQ(posted["traceparent"], "00-ab-cd-01");
  const auto get = std::make_shared<Request>();
  get->parameters = {{"id", "def"}};
  EXPECT_EQ(line(get, ok)["job"], "def");
  EXPECT_FALSE(line(std::make_shared<Request>(), ok).contains("job"));
}

TEST(Middleware, OnlyTheRequestsThatAreToBeLoggedGetALine) {
  const auto lines = [](LoggedRequests logged, int status) {
    testing::internal::CaptureStderr();
    run(access_log(logged), std::make_shared<Request>(),
        [&](const RequestPtr&, const Reply& reply) { reply(text_answer(status, "text/plain", "")); });
    const std::string text = testing::internal::GetCapturedStderr();
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines(LoggedRequests::all, 200), 1);
  EXPECT_EQ(lines(LoggedRequests::errors, 200), 0);
  EXPECT_EQ(lines(LoggedRequests::errors, 400), 1);
  EXPECT_EQ(lines(LoggedRequests::none, 500), 0);
}

TEST(Middleware, WorkOnThePoolIsAnsweredEvenIfItThrows) {
  Pool pool(1);
  std::vector<int> status;
  const Reply reply = [&](const Response& response) { status.push_back(response.status); };
  on_pool(pool, [](const Request&) { return text_answer(204, "text/plain", ""); })(std::make_shared<Request>(), reply);
  on_pool(pool, [](const Request&) -> Response { throw api::Problem("not-found", ""); })(std::make_shared<Request>(),
                                                                                         reply);
  pool.join();
  EXPECT_EQ(status, (std::vector<int>{204, 404}));
}

}  // namespace
}  // namespace bahnwerk::server
