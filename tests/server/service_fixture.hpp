#pragma once
/// A service with a stub in the place of parser and planner: no engine, no documents.
#include <atomic>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "api/problem.hpp"
#include "server/cli/http_client.hpp"
#include "server/runtime/clock.hpp"
#include "server/service.hpp"
#include "store/fixture.hpp"

namespace bahnwerk::server {

using cli::HttpClient;
using nlohmann::json;
using namespace std::chrono_literals;

/// {"rows":N} plans a ramp of N rows; {"forever":true} reports until it is stopped.
inline Engine stub_engine() {
  Engine engine;
  engine.parse = [](std::string_view body) {
    const json document = json::parse(body, nullptr, false);
    if (document.is_discarded()) throw api::Problem("invalid-json", "not JSON");
    api::JobRequest request;
    request.kind = "ramp";
    request.document = body;
    if (document.contains("deadline_in")) request.deadline = now_ms() + document["deadline_in"].get<int>();
    return request;
  };
  engine.plan = [](const std::string&, const std::string& text, Progress& progress) {
    const json document = json::parse(text);
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
      const Response response = get("/v1/jobs/" + id);
      const json job = json::parse(response.body);
      if (job.value("state", "") == state) return job;
      std::this_thread::sleep_for(2ms);
    }
    ADD_FAILURE() << id << " did not become " << state;
    return {};
  }
  /// In 100 ms, while the test waits. To be joined.
  std::thread cancel_soon(const std::string& id) const {
    return std::thread([this, id] {
      std::this_thread::sleep_for(100ms);
      client->request("POST", "/v1/jobs/" + id + "/cancel", {});
    });
  }
  TempFolder folder;
  ServiceOptions options;
  std::unique_ptr<Service> service;
  std::unique_ptr<HttpClient> client;
};

}  // namespace bahnwerk::server
