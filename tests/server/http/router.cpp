#include "server/http/router.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/http/uri.hpp"

namespace bahnwerk::server {
namespace {

Handler says(const std::string& text) {
  return [text](const RequestPtr& request, const Reply& reply) {
    std::string body = text;
    for (const auto& [name, value] : request->parameters) body += " " + name + "=" + value;
    reply(text_answer(200, "text/plain", body));
  };
}

struct RouterTest : testing::Test {
  RouterTest() {
    router.add("GET", "/", Access::open, says("root"));
    router.add("GET", "/v1/jobs/{id}", Access::open, says("job"));
    router.add("DELETE", "/v1/jobs/{id}", Access::open, says("delete"));
    router.add("GET", "/list", Access::open, says("list"), {"state", "limit"});
    router.add("GET", "/page", Access::page, says("page"), {"state"});
    router.add("GET", "/v1/jobs/newest", Access::open, says("newest"));
    router.add("GET", "/v1/jobs/{id}/files/{name}", Access::open, says("file"));
    router.add("POST", "/throws", Access::open,
               [](const RequestPtr&, const Reply&) { throw std::runtime_error("secret"); });
  }
  Response ask(const std::string& method, const std::string& target) {
    auto request = std::make_shared<Request>();
    request->method = method;
    request->target = target;
    const auto parsed = parse_target(target).value();
    request->path = parsed.path;
    request->segments = parsed.segments;
    request->query = parsed.query;
    Response answer;
    const Handler handler =
        compose({request_id(), guard()}, [&](const RequestPtr& r, const Reply& reply) { router(r, reply); });
    handler(request, [&](Response response) { answer = std::move(response); });
    route = request->route;
    return answer;
  }
  Router router;
  std::string route;
};

TEST_F(RouterTest, FindsHandlersAndParameters) {
  EXPECT_EQ(ask("GET", "/").body, "root");
  EXPECT_EQ(ask("GET", "/v1/jobs/17?").body, "job id=17");
  EXPECT_EQ(route, "/v1/jobs/{id}");
  EXPECT_EQ(ask("GET", "/v1/jobs/a%2Fb/files/c").body, "file id=a/b name=c");
  EXPECT_EQ(ask("DELETE", "/v1/jobs/17").body, "delete id=17");
}

TEST_F(RouterTest, PrefersLiterals) { EXPECT_EQ(ask("GET", "/v1/jobs/newest").body, "newest"); }

TEST_F(RouterTest, AnswersHeadByGet) { EXPECT_EQ(ask("HEAD", "/v1/jobs/17").status, 200); }

TEST_F(RouterTest, ListsTheMethods) {
  const Response wrong = ask("PUT", "/v1/jobs/17");
  EXPECT_EQ(wrong.status, 405);
  EXPECT_EQ(wrong.header("Allow"), "DELETE, GET, HEAD, OPTIONS");
  const Response options = ask("OPTIONS", "/v1/jobs/17");
  EXPECT_EQ(options.status, 204);
  EXPECT_EQ(options.header("Allow"), "DELETE, GET, HEAD, OPTIONS");
}

TEST_F(RouterTest, FindsNothing) {
  for (const char* target : {"/v1", "/v1/jobs", "/v1/jobs/", "/v1/jobs/17/", "/v1/jobs/17/files", "//", "/v1//17"})
    EXPECT_EQ(ask("GET", target).status, 404) << target;
}

TEST_F(RouterTest, TakesOnlyTheParametersOfTheRouteOnceAndWithAValue) {
  EXPECT_EQ(ask("GET", "/list").body, "list");
  EXPECT_EQ(ask("GET", "/list?limit=3&state=queued").body, "list");
  const auto pointers = [&](const std::string& target) {
    const Response answer = ask("GET", target);
    EXPECT_EQ(answer.status, 422) << target;
    EXPECT_NE(answer.body.find("/problems/schema-violation"), std::string::npos);
    std::vector<std::string> list;
    const auto document = nlohmann::json::parse(answer.body);
    for (const auto& error : document["errors"]) list.push_back(error["pointer"]);
    return list;
  };
  using List = std::vector<std::string>;
  EXPECT_EQ(pointers("/list?limit="), List{"/query/limit"});
  EXPECT_EQ(pointers("/list?limit"), List{"/query/limit"});
  EXPECT_EQ(pointers("/list?limit=3&limit=3"), List{"/query/limit"});
  EXPECT_EQ(pointers("/list?colour=red&state="), (List{"/query/colour", "/query/state"}));
  EXPECT_EQ(pointers("/v1/jobs/17?x=y"), List{"/query/x"});
  EXPECT_EQ(pointers("/list?=1"), List{"/query/"});
  EXPECT_EQ(ask("GET", "/nothing?x=y").status, 404);
}

TEST_F(RouterTest, TakesEmptyParametersOfAPageAsAbsentBecauseFormsSendThem) {
  EXPECT_EQ(ask("GET", "/page?state=&state=queued").body, "page");
  EXPECT_EQ(ask("GET", "/page?colour=red").status, 422);
}

TEST_F(RouterTest, KeepsAnExceptionsTextToItself) {
  const Response answer = ask("POST", "/throws");
  EXPECT_EQ(answer.status, 500);
  EXPECT_EQ(answer.body.find("secret"), std::string::npos);
  EXPECT_NE(answer.body.find("/problems/internal"), std::string::npos);
  EXPECT_TRUE(answer.header("X-Request-Id"));
}

TEST(Compose, OrdersFromTheOutside) {
  std::string order;
  const auto named = [&](char name) -> Middleware {
    return [&order, name](Handler next) -> Handler {
      return [&order, name, next](RequestPtr request, Reply reply) {
        order += name;
        next(request, [&order, name, reply](Response response) {
          order += static_cast<char>(std::tolower(name));
          reply(std::move(response));
        });
      };
    };
  };
  compose({named('A'), named('B')}, says("x"))(std::make_shared<Request>(), [](const Response&) {});
  EXPECT_EQ(order, "ABba");
}

}  // namespace
}  // namespace bahnwerk::server
