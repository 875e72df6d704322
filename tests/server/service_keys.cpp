/// The service with keys: who may do what, over all routes.
#include <map>

#include "server/keys/key_text.hpp"
#include "server/store/open.hpp"
#include "service_fixture.hpp"

namespace bahnwerk::server {
namespace {

struct ServiceKeysTest : ServiceTest {
  std::string add(const std::string& name, const std::string& scopes, std::optional<std::int64_t> max_queued = {}) {
    NewKey made = make_key();
    made.key.name = name;
    made.key.scopes = parse_scopes(scopes).value();
    made.key.max_queued = max_queued;
    add_key(options.store, made.key);
    return made.text;
  }
  Response ask(const std::string& method, const std::string& path, const std::string& key, Pairs headers = {},
               const std::string& body = {}) const {
    if (!key.empty()) headers.emplace_back("Authorization", "Bearer " + key);
    return client->request(method, path, headers, body);
  }
  std::string post_as(const std::string& key, const std::string& body = R"({"rows":10})") const {
    const Response response = ask("POST", "/v1/jobs", key, {{"Content-Type", "application/json"}}, body);
    EXPECT_EQ(response.status, 202) << response.body;
    return json::parse(response.body).value("id", "");
  }
};

/// What a route answers to whoever may ask it.
const std::map<std::string, int> answers{{"POST /v1/jobs", 202},
                                         {"GET /v1/jobs", 200},
                                         {"GET /v1/jobs/{id}", 200},
                                         {"GET /v1/jobs/{id}/spec", 200},
                                         {"GET /v1/jobs/{id}/events", 200},
                                         {"GET /v1/jobs/{id}/result", 200},
                                         {"GET /v1/jobs/{id}/setpoints", 200},
                                         {"GET /v1/jobs/{id}/limits", 200},
                                         {"POST /v1/jobs/{id}/cancel", 202},
                                         {"POST /v1/jobs/{id}/retry", 409},  // it succeeded
                                         {"POST /v1/jobs/cancel", 422},      // without a filter
                                         {"DELETE /v1/jobs", 422},
                                         {"GET /v1/changes", 200},
                                         {"GET /v1/events", 406},  // the stream has no end: asked for as JSON
                                         {"DELETE /v1/jobs/{id}", 204},
                                         {"GET /v1/jobs/{id}/blocks", 404},  // a ramp has no blocks
                                         {"GET /v1/jobs/{id}/path", 200},
                                         {"GET /v1/jobs/{id}/scene", 404},  // and no scene
                                         {"POST /v1/check", 200},
                                         {"GET /v1/examples", 200},
                                         {"GET /v1/examples/{name}", 200},
                                         {"GET /v1/machines", 200},
                                         {"GET /v1/machines/{name}", 200},
                                         {"GET /v1/kinds", 200},
                                         {"GET /openapi.json", 200},
                                         {"GET /v1/schemas/{name}", 200},
                                         {"GET /problems/{slug}", 200},
                                         {"GET /healthz", 200},
                                         {"GET /readyz", 200},
                                         {"GET /metrics", 200},
                                         {"GET /assets/{version}/{name}", 404},  // a file of another version
                                         {"GET /", 200},
                                         {"GET /jobs", 200},
                                         {"GET /new", 200},
                                         {"GET /compare", 200},
                                         {"GET /jobs/{id}", 200},
                                         {"GET /jobs/{id}/drawings/{name}", 204},  // a job without drawings: see below
                                         {"POST /login", 415},
                                         {"POST /logout", 303}};

TEST_F(ServiceKeysTest, EveryRouteAsksWhoItIs) {
  const std::string read = add("acme", "read"), submit = add("acme", "submit"), admin = add("boss", "admin"),
                    other = add("other", "submit,read");
  start();
  struct Caller {
    const char* who;
    std::string key;
  };
  const Caller callers[] = {{"nobody", ""}, {"wrong", make_key().text}, {"other", other},
                            {"read", read}, {"submit", submit},         {"admin", admin}};
  const auto expected = [](const Router::Entry& route, const std::string& who, int right) {
    const bool known = who != "nobody" && who != "wrong", own = route.pattern.find("{id}") != std::string::npos;
    switch (route.access) {
      case Access::open:
        return right;
      case Access::any:
        return known ? right : 401;
      case Access::metrics:
        return who == "wrong" ? 401 : right;  // this machine asks
      case Access::admin:
        return !known ? 401 : who == "admin" ? right : 403;
      case Access::read:
      case Access::page:
      case Access::submit:
        break;
    }
    if (!known) return 401;
    if (who == (route.access == Access::submit ? "read" : "submit")) return 403;
    return who == "other" && own ? 404 : right;
  };
  for (const Router::Entry& route : service->routes()) {
    const std::string name = route.method + " " + route.pattern;
    ASSERT_TRUE(answers.contains(name)) << name << " is a new route: say here what it answers";
    for (const Caller& caller : callers) {
      const std::string id = post_as(submit);
      while (json::parse(ask("GET", "/v1/jobs/" + id, admin).body).value("state", "") != "succeeded")
        std::this_thread::sleep_for(1ms);
      std::string path = route.pattern;
      const auto fill = [&](const std::string& parameter, const std::string& value) {
        if (const auto at = path.find(parameter); at != std::string::npos) path.replace(at, parameter.size(), value);
      };
      fill("{id}", id);
      fill("{name}", route.pattern.starts_with("/v1/schemas")    ? "job"
                     : route.pattern.starts_with("/v1/examples") ? "bracket"
                     : route.pattern.starts_with("/v1/machines") ? "robot"
                                                                 : "plan.svg");
      fill("{slug}", "not-found");
      fill("{version}", "0");
      Pairs headers;
      if (route.access == Access::page) headers = {{"Accept", "text/html,image/svg+xml"}};
      const bool posts = name == "POST /v1/jobs" || name == "POST /v1/check";
      if (posts) headers = {{"Content-Type", "application/json"}};
      if (name == "GET /v1/events") headers = {{"Accept", "application/json"}};
      const Response response = ask(route.method, path, caller.key, headers, posts ? R"({"rows":1})" : "");
      int status = response.status;
      if (response.body.find("has no drawing") != std::string::npos) status = 204;
      EXPECT_EQ(status, expected(route, caller.who, answers.at(name))) << name << " by " << caller.who << response.body;
      EXPECT_EQ(status == 401, response.header("WWW-Authenticate") && status != 403) << name;
    }
  }
}

TEST_F(ServiceKeysTest, ListsAndIdempotencyKeysAreTheOwnersAlone) {
  options.workers = 0;
  const std::string acme = add("acme", "submit,read"), other = add("other", "submit,read"),
                    admin = add("boss", "admin");
  start();
  const Pairs once{{"Content-Type", "application/json"}, {"Idempotency-Key", "order 1"}};
  const auto post_once = [&](const std::string& key) {
    return json::parse(ask("POST", "/v1/jobs", key, once, R"({"rows":1})").body).value("id", "");
  };
  const std::string first = post_once(acme), second = post_once(other);
  EXPECT_NE(first, second);
  EXPECT_EQ(post_once(acme), first);
  const auto list = [&](const std::string& key, const std::string& query = "") {
    std::vector<std::string> ids;
    const json answer = json::parse(ask("GET", "/v1/jobs" + query, key).body);
    for (const auto& job : answer["jobs"]) ids.push_back(job["id"]);
    return ids;
  };
  EXPECT_EQ(list(acme), std::vector{first});
  EXPECT_EQ(list(other, "?state=queued&kind=ramp"), std::vector{second});
  EXPECT_EQ(list(admin).size(), 2U);
  const std::string page = ask("GET", "/", acme, {{"Accept", "text/html"}}).body;
  EXPECT_NE(page.find(first), std::string::npos);
  EXPECT_EQ(page.find(second), std::string::npos);
}

TEST_F(ServiceKeysTest, ChangesAreTheOwnersAlone) {
  options.workers = 0;
  const std::string acme = add("acme", "submit,read"), other = add("other", "submit,read"),
                    admin = add("boss", "admin");
  start();
  const std::string mine = post_as(acme), theirs = post_as(other), gone = post_as(acme);
  EXPECT_EQ(ask("DELETE", "/v1/jobs/" + gone, acme).status, 204);
  const auto changed = [&](const std::string& key) {
    std::vector<std::string> ids;
    const json answer = json::parse(ask("GET", "/v1/changes?since=0", key).body);
    for (const auto& change : answer["changes"]) ids.push_back(change["id"]);
    EXPECT_TRUE(
        json::parse(ask("GET", "/v1/changes?since=" + std::to_string(answer.value("next", 0)), key).body)["changes"]
            .empty());
    return ids;
  };
  EXPECT_EQ(changed(acme), (std::vector{mine, gone}));
  EXPECT_EQ(changed(other), std::vector{theirs});
  EXPECT_EQ(changed(admin), (std::vector{mine, theirs, gone}));
}

TEST_F(ServiceKeysTest, AJobPlannedOnceMoreStaysItsOwners) {
  options.workers = 0;
  const std::string acme = add("acme", "submit,read"), admin = add("boss", "admin");
  start();
  const std::string id = post_as(acme);
  EXPECT_EQ(ask("POST", "/v1/jobs/" + id + "/cancel", acme).status, 202);
  const Response again = ask("POST", "/v1/jobs/" + id + "/retry", admin);
  EXPECT_EQ(again.status, 202) << again.body;
  EXPECT_EQ(ask("GET", "/v1/jobs/" + json::parse(again.body).value("id", ""), acme).status, 200);
}

TEST_F(ServiceKeysTest, AQuotaOfQueuedJobsIsTheNamesOwn) {
  options.workers = 0;
  const std::string acme = add("acme", "submit,read", 2), other = add("other", "submit");
  start();
  post_as(acme);
  post_as(acme);
  const Response refused = ask("POST", "/v1/jobs", acme, {{"Content-Type", "application/json"}}, R"({"rows":1})");
  EXPECT_EQ(refused.status, 429);
  EXPECT_TRUE(refused.header("Retry-After"));
  post_as(other);
}

TEST_F(ServiceKeysTest, AStreamEndsWhenItsKeyIsRemoved) {
  const std::string acme = add("acme", "submit,read");
  start();
  const std::string id = post_as(acme, R"({"forever":true})");
  auto stream = std::async(std::launch::async, [&] { return ask("GET", "/v1/jobs/" + id + "/events", acme); });
  EXPECT_TRUE(soon([&] { return connections() == 1; }));
  remove_keys(options.store, "acme");
  EXPECT_EQ(taken(stream).status, 200);
  EXPECT_EQ(ask("GET", "/v1/jobs/" + id, acme).status, 401);
}

TEST_F(ServiceKeysTest, AFormGivesABrowserACookieThatServesPagesOfThisServiceAlone) {
  const std::string acme = add("acme", "submit,read");
  start();
  const Pairs form{{"Content-Type", "application/x-www-form-urlencoded"}}, html{{"Accept", "text/html"}};
  const Response page = ask("GET", "/", "", html);
  EXPECT_EQ(page.status, 401);
  EXPECT_NE(page.body.find("<form"), std::string::npos);
  EXPECT_EQ(ask("POST", "/login", "", form, "key=bw_wrong&to=/").status, 401);
  const Response entered = ask("POST", "/login", "", form, "key=" + acme + "&to=//evil.example");
  EXPECT_EQ(entered.status, 303);
  EXPECT_EQ(entered.header("Location"), "/");
  const std::string cookie = entered.header("Set-Cookie").value_or("");
  for (const char* part : {"HttpOnly", "SameSite=Strict", "Path=/"})
    EXPECT_NE(cookie.find(part), std::string::npos) << part;
  const std::string sent = cookie.substr(0, cookie.find(';'));
  EXPECT_EQ(get("/", {{"Accept", "text/html"}, {"Cookie", "a=b; " + sent}}).status, 200);
  // What changes something needs an Origin that is this service: any other one and none at all are refused.
  const std::string own = "http://" + service->address();
  EXPECT_EQ(post(R"({"rows":1})", {{"Cookie", sent}}).status, 401);
  for (const char* other : {"http://evil.example", "null", "https://evil.example:443", "http://127.0.0.1:1"})
    EXPECT_EQ(post(R"({"rows":1})", {{"Cookie", sent}, {"Origin", other}}).status, 403) << other;
  EXPECT_EQ(post(R"({"rows":1})", {{"Cookie", sent}, {"Origin", own}}).status, 202);
  EXPECT_EQ(post(R"({"rows":1})", {{"Cookie", "bahnwerk_key=bw_wrong"}, {"Origin", own}}).status, 401);
  const Response left = ask("POST", "/logout", "", {{"Cookie", sent}, {"Origin", own}}, "");
  EXPECT_EQ(left.status, 303);
  EXPECT_NE(left.header("Set-Cookie").value_or("").find("bahnwerk_key=; Path=/; HttpOnly"), std::string::npos);
  EXPECT_NE(left.header("Set-Cookie").value_or("").find("Max-Age=0"), std::string::npos);
}

TEST_F(ServiceKeysTest, ACookieHasNoMoreScopesThanItsKey) {
  const std::string reader = add("acme", "read");
  start();
  const std::string own = "http://" + service->address(), cookie = "bahnwerk_key=" + reader;
  EXPECT_EQ(get("/v1/jobs", {{"Cookie", cookie}}).status, 200);
  EXPECT_EQ(post(R"({"rows":1})", {{"Cookie", cookie}, {"Origin", own}}).status, 403);
}

TEST_F(ServiceKeysTest, AnOriginThatMayAskGetsNothingByACookie) {
  options.cors_origins = {"https://plant.example"};
  const std::string acme = add("acme", "submit,read");
  start();
  EXPECT_EQ(post(R"({"rows":1})", {{"Cookie", "bahnwerk_key=" + acme}, {"Origin", "https://plant.example"}}).status,
            401);
}

}  // namespace
}  // namespace bahnwerk::server
