#pragma once
/// A service with a stub in the place of parser and planner: no engine, no documents.
#include <atomic>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "api/problem.hpp"
#include "manual_time.hpp"
#include "server/http/http_client.hpp"
#include "server/runtime/clock.hpp"
#include "server/service.hpp"
#include "store/fixture.hpp"

namespace bahnwerk::server {

using nlohmann::json;
using namespace std::chrono_literals;

/// {"rows":N} plans a ramp of N rows; {"forever":true} reports until it is stopped; {"deadline_in":MS} has a deadline.
inline Engine stub_engine(const TimeSource& time = system_time()) {
  Engine engine;
  engine.preview = [](std::string_view, Progress) {
    return nlohmann::ordered_json{{"kind", "ramp"}, {"checked", true}};
  };
  engine.parse = [&time](std::string_view body, Progress) {
    const json document = json::parse(body, nullptr, false);
    if (document.is_discarded()) throw api::Problem("invalid-json", "not JSON");
    api::JobRequest request;
    request.kind = "ramp";
    request.document = body;
    if (document.contains("deadline_in")) request.deadline = time.now_ms() + document["deadline_in"].get<int>();
    return request;
  };
  engine.plan = [](const std::string&, const std::string& text, Progress progress) {
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
    options.drain_timeout = 50ms;  // for jobs that never end; whoever ends has time enough on a busy machine
    options.stop_patience = options.answer_patience = 30s;
  }
  /// Whether `condition` has come true, within 30 s.
  template <class Condition>
  static bool soon(Condition condition) {
    for (int i = 0; i < 15'000; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(2ms);
    }
    return false;
  }
  void start() {
    service = std::make_unique<Service>(options, stub_engine());
    client = std::make_unique<HttpClient>("http://" + service->address());
  }
  /// A service whose time stands still until the test moves it.
  void start_with_manual_time() {
    service = std::make_unique<Service>(options, stub_engine(time), time);
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
    json job;
    const auto reached = [&] {
      job = json::parse(get("/v1/jobs/" + id).body);
      return job.value("state", "") == state;
    };
    EXPECT_TRUE(soon(reached)) << id << " did not become " << state;
    return job;
  }
  void cancel(const std::string& id) const { client->request("POST", "/v1/jobs/" + id + "/cancel", {}); }
  /// How many connections are open, that of the question not counted.
  int connections() const {
    const std::string text = get("/metrics").body, name = "\nbahnwerk_http_connections ";
    return std::stoi(text.substr(text.find(name) + name.size())) - 1;
  }
  /// A request on a thread of its own, one at a time. Returns when its connection is open.
  std::future<Response> held(const std::string& path, const Pairs& headers) const {
    EXPECT_TRUE(soon([&] { return connections() == 0; }));
    auto answer = std::async(std::launch::async, [=, this] { return get(path, headers); });
    EXPECT_TRUE(soon([&] { return connections() == 1 || is_ready(answer); }));
    return answer;
  }
  static bool is_ready(const std::future<Response>& answer) { return answer.wait_for(0s) == std::future_status::ready; }
  /// The answer, waited for 30 s.
  static Response taken(std::future<Response>& answer) {
    EXPECT_EQ(answer.wait_for(30s), std::future_status::ready);
    return answer.get();
  }
  /// Lets a second pass, of which 500 ms may have passed already, for an answer that is given then and not before.
  void let_a_second_pass(const std::future<Response>& answer) {
    time.advance(499ms);
    EXPECT_FALSE(is_ready(answer)) << "too early";
    EXPECT_TRUE(soon([&] {  // the server may have begun to count only now
      time.advance(1ms);
      return is_ready(answer);
    }));
  }
  /// Lets a planner that reports without end show something new.
  void await_progress(const std::string& id) {
    const auto etag = [&] { return get("/v1/jobs/" + id).header("ETag"); };
    const auto before = etag();
    time.advance(100ms);
    EXPECT_TRUE(soon([&] { return etag() != before; }));
  }
  TempFolder folder;
  ManualTime time;
  ServiceOptions options;
  std::unique_ptr<Service> service;
  std::unique_ptr<HttpClient> client;
};

}  // namespace bahnwerk::server
