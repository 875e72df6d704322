/// The service from socket to store, with a stub in the place of parser and planner: no engine, no documents.
#include "server/service.hpp"

#include <atomic>
#include <nlohmann/json.hpp>
#include <random>

#include "api/problem.hpp"
#include "server/cli/http_client.hpp"
#include "store/fixture.hpp"

namespace bahnwerk::server {
namespace {

using cli::HttpClient;
using nlohmann::json;
using namespace std::chrono_literals;

/// {"rows":N} plans a ramp of N rows; {"forever":true} reports until it is stopped.
Engine stub_engine() {
  Engine engine;
  engine.parse = [](std::string_view body) {
    const json document = json::parse(body, nullptr, false);
    if (document.is_discarded()) throw api::Problem("invalid-json", "not JSON");
    api::JobRequest request;
    request.kind = "ramp";
    request.spec = document.dump();
    return request;
  };
  engine.plan = [](const std::string&, const std::string& spec, Progress& progress) {
    const json document = json::parse(spec);
    while (document.value("forever", false)) {
      progress.report("forever", 0.5, "round and round");
      std::this_thread::sleep_for(2ms);
    }
    return ramp_plan(document.value("rows", std::size_t{10}));
  };
  return engine;
}

struct ServiceTest : testing::Test {
  ServiceTest() {
    options.listen = "127.0.0.1:0";
    options.store = "sqlite:" + (folder.path / "store.db").string();
    options.workers = 2;
    options.drain_timeout = 200ms;
  }
  void start() {
    service = std::make_unique<Service>(options, stub_engine());
    client = std::make_unique<HttpClient>("http://" + service->address());
  }
  Response get(const std::string& path, const Pairs& headers = {}) const {
    return client->request("GET", path, headers);
  }
  Response post(const std::string& body, const Pairs& more = {}) const {
    Pairs headers{{"Content-Type", "application/json"}};
    headers.insert(headers.end(), more.begin(), more.end());
    return client->request("POST", "/v1/jobs", headers, body);
  }
  std::string posted(const std::string& body) const {
    const Response response = post(body);
    EXPECT_EQ(response.status, 202) << response.body;
    return json::parse(response.body).value("id", "");
  }
  json await(const std::string& id, const std::string& state) const {
    for (int i = 0; i < 2000; ++i) {
      const Response response = get("/v1/jobs/" + id, {{"Prefer", "wait=1"}});
      const json job = json::parse(response.body);
      if (job.value("state", "") == state) return job;
      std::this_thread::sleep_for(2ms);
    }
    ADD_FAILURE() << id << " did not become " << state;
    return {};
  }
  TempFolder folder;
  ServiceOptions options;
  std::unique_ptr<Service> service;
  std::unique_ptr<HttpClient> client;
};

TEST_F(ServiceTest, CarriesAJobTheWholeWay) {
  start();
  const std::string id = posted(R"({"rows":10000})");
  const json job = await(id, "succeeded");
  EXPECT_EQ(job["spec"], json::parse(R"({"rows":10000})"));
  EXPECT_EQ(json::parse(get("/v1/jobs/" + id + "/result").body)["rows"], 10000);
  const Response csv = get("/v1/jobs/" + id + "/setpoints?first=4090&count=10&columns=x", {{"Accept", "text/csv"}});
  EXPECT_EQ(csv.body, "x\n4090\n4091\n4092\n4093\n4094\n4095\n4096\n4097\n4098\n4099\n");
  const Response binary = get("/v1/jobs/" + id + "/setpoints", {{"Accept", "application/octet-stream"}});
  EXPECT_EQ(binary.body.size(), 10000U * 2 * 8);
  EXPECT_EQ(binary.header("X-Columns"), "x,y");
  EXPECT_EQ(client->request("DELETE", "/v1/jobs/" + id, {}).status, 204);
  EXPECT_EQ(get("/v1/jobs/" + id).status, 404);
}

TEST_F(ServiceTest, AnswersFaultsAsProblems) {
  start();
  const auto slug = [](const Response& response) { return json::parse(response.body).value("type", ""); };
  EXPECT_EQ(slug(post("{")), "/problems/invalid-json");
  EXPECT_EQ(slug(get("/nothing")), "/problems/not-found");
  EXPECT_EQ(slug(client->request("POST", "/v1/jobs", {{"Content-Type", "text/plain"}}, "{}")),
            "/problems/unsupported-media-type");
  EXPECT_EQ(slug(client->request("PUT", "/v1/jobs", {}, "")), "/problems/method-not-allowed");
  const std::string id = posted(R"({"forever":true})");
  await(id, "running");
  EXPECT_EQ(slug(get("/v1/jobs/" + id + "/result")), "/problems/job-not-finished");
  EXPECT_EQ(slug(client->request("DELETE", "/v1/jobs/" + id, {})), "/problems/job-not-finished");
  EXPECT_EQ(client->request("POST", "/v1/jobs/" + id + "/cancel", {}).status, 202);
  EXPECT_EQ(await(id, "cancelled")["error"]["type"], "/problems/cancelled");
  EXPECT_EQ(slug(get("/v1/jobs/" + id + "/result")), "/problems/not-found");
}

TEST_F(ServiceTest, HoldsAnAnswerUntilTheJobChanges) {
  options.workers = 0;
  start();
  const std::string id = posted("{}");
  const std::string etag = get("/v1/jobs/" + id).header("ETag").value();
  EXPECT_EQ(get("/v1/jobs/" + id, {{"If-None-Match", etag}}).status, 304);
  const auto start_time = std::chrono::steady_clock::now();
  EXPECT_EQ(get("/v1/jobs/" + id, {{"If-None-Match", etag}, {"Prefer", "wait=1"}}).status, 304);
  EXPECT_GE(std::chrono::steady_clock::now() - start_time, 900ms);
  std::thread other([&] {
    std::this_thread::sleep_for(100ms);
    client->request("POST", "/v1/jobs/" + id + "/cancel", {});
  });
  const Response changed = get("/v1/jobs/" + id, {{"Prefer", "wait=60"}});
  other.join();
  EXPECT_EQ(json::parse(changed.body)["state"], "cancelled");
  EXPECT_LT(std::chrono::steady_clock::now() - start_time, 30s);
}

TEST_F(ServiceTest, DrainsUnderLoad) {
  start();
  std::atomic<bool> stop{false};
  std::atomic<int> accepted{0}, refused{0};
  const std::string forever = posted(R"({"forever":true})");
  await(forever, "running");
  std::vector<std::thread> clients;
  for (int i = 0; i < 4; ++i)
    clients.emplace_back([&] {
      while (!stop) {
        try {
          const int status = post(R"({"rows":100})").status;
          ++(status == 202 ? accepted : refused);
          EXPECT_TRUE(status == 202 || status == 503) << status;
        } catch (const cli::Unreachable&) {
          return;
        }
      }
    });
  clients.emplace_back([&] {
    try {
      get("/v1/jobs/" + forever + "?", {{"Prefer", "wait=60"}});
      while (!stop) get("/v1/jobs/" + forever, {{"Prefer", "wait=60"}});
    } catch (const cli::Unreachable&) {
    }
  });
  std::this_thread::sleep_for(300ms);
  EXPECT_TRUE(service->drain());
  stop = true;
  service.reset();
  for (auto& thread : clients) thread.join();
  EXPECT_GT(accepted, 0);
  // Whatever was accepted is there at the next start; what ran is queued again without having lost an attempt.
  options.workers = 0;
  start();
  const auto counts = [&] {
    std::size_t count = 0;
    std::string cursor;
    do {
      const json page = json::parse(get("/v1/jobs?limit=200&cursor=" + cursor).body);
      count += page["jobs"].size();
      cursor = page["next"].is_string() ? page["next"].get<std::string>() : "";
    } while (!cursor.empty());
    return count;
  };
  EXPECT_GE(counts(), static_cast<std::size_t>(accepted) + 1);
  const json job = json::parse(get("/v1/jobs/" + forever).body);
  EXPECT_EQ(job["state"], "queued");
  EXPECT_EQ(job["attempt"], 0);
}

TEST_F(ServiceTest, StandsManyClientsAtOnce) {
  start();
  std::vector<std::thread> clients;
  for (unsigned seed = 1; seed <= 6; ++seed)
    clients.emplace_back([&, seed] {
      std::mt19937 random(seed);
      std::vector<std::string> ids{"none"};
      for (int i = 0; i < 60; ++i) {
        const std::string& id = ids[random() % ids.size()];
        int status = 0;
        switch (random() % 8) {
          case 0:
          case 1:
            ids.push_back(posted(R"({"rows":5000})"));
            break;
          case 2:
            ids.push_back(posted(R"({"forever":true})"));
            break;
          case 3:
            status = client->request("POST", "/v1/jobs/" + id + "/cancel", {}).status;
            break;
          case 4:
            status = client->request("DELETE", "/v1/jobs/" + id, {}).status;
            break;
          case 5:
            status = get("/v1/jobs?limit=20").status;
            break;
          case 6:
            status = get("/metrics").status;
            break;
          default:
            try {
              status = get("/v1/jobs/" + id + "/setpoints", {{"Accept", "text/csv"}}).status;
            } catch (const cli::Unreachable&) {  // deleted by its own client meanwhile: the answer breaks off
            }
        }
        EXPECT_LT(status, 500);
      }
      for (const auto& id : ids) client->request("POST", "/v1/jobs/" + id + "/cancel", {});
    });
  for (auto& thread : clients) thread.join();
  EXPECT_EQ(get("/readyz").status, 200);
  EXPECT_TRUE(service->drain());
}

TEST_F(ServiceTest, EndsWithoutADrain) {
  start();
  const std::string id = posted(R"({"forever":true})");
  await(id, "running");
  std::thread waiter([&] {
    try {
      get("/v1/jobs/" + id, {{"Prefer", "wait=60"}});
    } catch (const cli::Unreachable&) {
    }
  });
  service.reset();
  waiter.join();
}

TEST_F(ServiceTest, SaysWhyItCannotStart) {
  start();
  ServiceOptions second = options;
  second.listen = service->address();
  second.store = "sqlite:" + (folder.path / "other.db").string();
  EXPECT_THROW(Service(second, stub_engine()), std::runtime_error);
  second.listen = "nonsense";
  EXPECT_THROW(Service(second, stub_engine()), std::runtime_error);
  second.store = "postgresql://x";
  EXPECT_THROW(Service(second, stub_engine()), StoreError);
}

}  // namespace
}  // namespace bahnwerk::server
