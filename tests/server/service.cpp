/// The service from socket to store, with a stub in the place of parser and planner: no engine, no documents.
#include "server/service.hpp"

#include <atomic>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "api/problem.hpp"
#include "server/cli/http_client.hpp"
#include "server/runtime/clock.hpp"
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
  TempFolder folder;
  ServiceOptions options;
  std::unique_ptr<Service> service;
  std::unique_ptr<HttpClient> client;
};

TEST_F(ServiceTest, CarriesAJobTheWholeWay) {
  start();
  const std::string id = posted(R"({"rows":10000})");
  const json job = await(id, "succeeded");
  EXPECT_FALSE(job.contains("spec"));
  EXPECT_EQ(get("/v1/jobs/" + id + "/spec").body, R"({"rows":10000})");
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
  for (const char* part : {"/result", "/setpoints"}) {
    const Response response = get("/v1/jobs/" + id + part);
    EXPECT_EQ(response.status, 409);
    EXPECT_EQ(slug(response), "/problems/no-result");
    EXPECT_EQ(json::parse(response.body)["error"]["type"], "/problems/cancelled");
  }
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

TEST_F(ServiceTest, WaitsForTheEndWithoutIfNoneMatch) {
  start();
  const std::string id = posted(R"({"forever":true})");
  await(id, "running");
  const auto began = std::chrono::steady_clock::now();
  const Response held = get("/v1/jobs/" + id, {{"Prefer", "wait=1"}});
  EXPECT_GE(std::chrono::steady_clock::now() - began, 900ms) << "progress is not the end";
  EXPECT_EQ(json::parse(held.body)["state"], "running");
  EXPECT_EQ(held.header("Preference-Applied"), "wait=1");
  std::thread other([&] {
    std::this_thread::sleep_for(100ms);
    client->request("POST", "/v1/jobs/" + id + "/cancel", {});
  });
  const Response ended = get("/v1/jobs/" + id, {{"Prefer", "wait=60"}});
  other.join();
  EXPECT_EQ(json::parse(ended.body)["state"], "cancelled");
  EXPECT_EQ(json::parse(get("/v1/jobs/" + id, {{"Prefer", "wait=60"}}).body)["state"], "cancelled");
  EXPECT_LT(std::chrono::steady_clock::now() - began, 30s) << "answers at once when the job has ended";
}

TEST_F(ServiceTest, ProgressAnswersAWaiterOnceASecond) {
  start();
  const std::string id = posted(R"({"forever":true})");
  await(id, "running");
  std::string etag = get("/v1/jobs/" + id).header("ETag").value();
  const auto began = std::chrono::steady_clock::now();
  for (int i = 0; i < 2; ++i) {
    if (i == 1) std::this_thread::sleep_for(300ms);  // the ETag is old when the client comes
    const Response response = get("/v1/jobs/" + id, {{"If-None-Match", etag}, {"Prefer", "wait=60"}});
    EXPECT_EQ(response.status, 200);
    EXPECT_NE(response.header("ETag"), etag);
    etag = response.header("ETag").value_or("");
  }
  EXPECT_GE(std::chrono::steady_clock::now() - began, 2s);
  // Without waiting, every look shows what is new.
  EXPECT_EQ(get("/v1/jobs/" + id, {{"If-None-Match", "\"1\""}}).status, 200);
  // A change of state is told at once, also to who comes late.
  const auto late = std::chrono::steady_clock::now();
  EXPECT_EQ(get("/v1/jobs/" + id, {{"If-None-Match", "\"1\""}, {"Prefer", "wait=60"}}).status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - late, 900ms);
}

/// The events of a stream as id, name and data.
struct Event {
  std::uint64_t id;
  std::string name;
  json data;
};
std::vector<Event> parse_events(const std::string& text) {
  std::vector<Event> events;
  std::istringstream lines(text);
  Event event{};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("id: ")) event.id = std::stoull(line.substr(4));
    if (line.starts_with("event: ")) event.name = line.substr(7);
    if (line.starts_with("data: ")) event.data = json::parse(line.substr(6));
    if (line.empty() && !event.name.empty()) events.push_back(std::exchange(event, {}));
  }
  return events;
}

TEST_F(ServiceTest, StreamsEventsToTheEnd) {
  start();
  const std::string id = posted(R"({"forever":true})");
  std::thread other([&] {
    std::this_thread::sleep_for(1500ms);
    client->request("POST", "/v1/jobs/" + id + "/cancel", {});
  });
  const Response response = get("/v1/jobs/" + id + "/events");
  other.join();
  EXPECT_EQ(response.header("Content-Type"), "text/event-stream");
  const auto list = parse_events(response.body);
  ASSERT_GE(list.size(), 3U) << response.body;
  for (std::size_t i = 1; i < list.size(); ++i) EXPECT_GT(list[i].id, list[i - 1].id);
  std::vector<std::string> states;
  int progress = 0;
  for (const Event& event : list) {
    if (event.name == "state") states.push_back(event.data["state"]);
    if (event.name == "progress") ++progress;
    EXPECT_EQ(event.name == "progress", event.data.contains("fraction"));
  }
  if (states.front() == "queued") states.erase(states.begin());
  EXPECT_EQ(states, (std::vector<std::string>{"running", "cancelled"}));
  EXPECT_GE(progress, 1);
  EXPECT_LE(progress, 2) << "at most once a second";

  const auto resumed = [&](std::uint64_t last) {
    return get("/v1/jobs/" + id + "/events", {{"Last-Event-ID", std::to_string(last)}});
  };
  const auto rest = parse_events(resumed(list[list.size() - 2].id).body);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].data["state"], "cancelled");
  EXPECT_EQ(rest[0].id, list.back().id);
  EXPECT_EQ(resumed(list.back().id).status, 204) << "nothing more to come";
  // From the queue's event on, no state is left out, however fast the job was.
  const auto all = parse_events(resumed(1).body);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].data["state"], "running");
  EXPECT_EQ(all[1].data["state"], "cancelled");
  EXPECT_EQ(get("/v1/jobs/" + id + "/events", {{"Accept", "application/json"}}).status, 406);
  EXPECT_EQ(get("/v1/jobs/nobody/events").status, 404);
}

TEST_F(ServiceTest, ManyStreamsTakeNoThreadsAndEndWithTheService) {
  start();
  const std::string id = posted(R"({"forever":true})");
  await(id, "running");
  const auto threads = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), std::filesystem::directory_iterator());
  };
  std::atomic<int> ended{0};
  std::vector<std::thread> clients;
  const auto before = threads();
  for (int i = 0; i < 100; ++i)
    clients.emplace_back([&] {
      EXPECT_FALSE(parse_events(get("/v1/jobs/" + id + "/events").body).empty());
      ++ended;
    });
  std::this_thread::sleep_for(500ms);
  EXPECT_LE(threads() - before, 100) << "the clients' own";
  EXPECT_EQ(get("/healthz").status, 200);
  EXPECT_EQ(ended, 0);
  EXPECT_EQ(service->drain(), Service::Drained::clean);
  for (auto& thread : clients) thread.join();
  EXPECT_EQ(ended, 100);
}

TEST_F(ServiceTest, EndsAQueuedJobAtItsDeadline) {
  options.workers = 0;
  start();
  const std::string id = posted(R"({"deadline_in":300})");
  const auto began = std::chrono::steady_clock::now();
  const json job = json::parse(get("/v1/jobs/" + id, {{"Prefer", "wait=30"}}).body);
  EXPECT_EQ(job["state"], "failed");
  EXPECT_EQ(job["error"]["type"], "/problems/deadline-exceeded");
  EXPECT_LT(std::chrono::steady_clock::now() - began, 10s);
}

TEST_F(ServiceTest, LeavesNoDatabaseWhenTheAddressIsTaken) {
  start();
  ServiceOptions second = options;
  second.listen = service->address();
  second.store = "sqlite:" + (folder.path / "new" / "other.db").string();
  EXPECT_THROW(Service(second, stub_engine()), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "new"));
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
  EXPECT_EQ(service->drain(), Service::Drained::clean);
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
      const json page = json::parse(get("/v1/jobs?limit=200" + (cursor.empty() ? "" : "&cursor=" + cursor)).body);
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
  EXPECT_EQ(service->drain(), Service::Drained::clean);
}

TEST_F(ServiceTest, EndsInTimeWhateverItIsDoing) {
  using Clock = std::chrono::steady_clock;
  options.drain_timeout = 300ms;
  Engine engine = stub_engine();
  engine.parse = [parse = engine.parse](std::string_view body) {
    if (body == R"({"slow":true})") std::this_thread::sleep_for(3s);
    return parse(body);
  };
  service = std::make_unique<Service>(options, std::move(engine));
  client = std::make_unique<HttpClient>("http://" + service->address());
  await(posted(R"({"forever":true})"), "running");
  std::thread checked([&] {  // nothing can stop a check
    try {
      HttpClient("http://" + service->address())
          .request("POST", "/v1/jobs", {{"Content-Type", "application/json"}}, R"({"slow":true})");
    } catch (const cli::Unreachable&) {
    }
  });
  std::this_thread::sleep_for(300ms);
  const auto start = Clock::now();
  EXPECT_EQ(service->drain(), Service::Drained::late);
  EXPECT_LE(Clock::now() - start, options.drain_timeout + 1s);
  service.reset();  // waits for the check; the process would not
  checked.join();
}

TEST_F(ServiceTest, LooksAtJobsWhileDocumentsAreChecked) {
  std::atomic<bool> over{false};
  std::atomic<int> checking{0}, checked{0}, answered{0};
  Engine engine = stub_engine();
  engine.parse = [&, parse = engine.parse](std::string_view body) {
    if (body == R"({"slow":true})") {
      ++checking;
      while (!over) std::this_thread::sleep_for(1ms);
      ++checked;
    }
    return parse(body);
  };
  service = std::make_unique<Service>(options, std::move(engine));
  client = std::make_unique<HttpClient>("http://" + service->address());
  const std::string id = posted("{}");
  std::vector<std::thread> posters;
  for (int i = 0; i < 16; ++i)
    posters.emplace_back([&] {
      HttpClient("http://" + service->address())
          .request("POST", "/v1/jobs", {{"Content-Type", "application/json"}}, R"({"slow":true})");
      ++answered;
    });
  for (int i = 0; i < 5000 && checking == 0; ++i) std::this_thread::sleep_for(1ms);
  EXPECT_GE(checking, 1) << "documents are being checked";
  await(id, "succeeded");
  EXPECT_EQ(get("/readyz").status, 200);
  EXPECT_EQ(checked, 0);
  EXPECT_EQ(answered, 0);
  over = true;
  for (auto& thread : posters) thread.join();
  EXPECT_EQ(checked, 16);
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
  std::this_thread::sleep_for(100ms);  // the waiter is being held
  const auto began = std::chrono::steady_clock::now();
  service.reset();
  waiter.join();
  EXPECT_LT(std::chrono::steady_clock::now() - began, 20s) << "neither the job nor the waiter holds it up";
  options.workers = 0;
  start();
  EXPECT_EQ(json::parse(get("/v1/jobs/" + id).body)["state"], "queued") << "the job is taken up again";
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
