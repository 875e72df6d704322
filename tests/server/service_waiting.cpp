/// Clients that wait for a job and follow it, with a stub in the place of parser and planner.
#include <atomic>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "api/problem.hpp"
#include "server/cli/http_client.hpp"
#include "server/runtime/clock.hpp"
#include "server/service.hpp"
#include "service_fixture.hpp"

namespace bahnwerk::server {
namespace {

TEST_F(ServiceTest, HoldsAnAnswerUntilTheJobChanges) {
  options.workers = 0;
  start();
  const std::string id = posted("{}");
  const std::string etag = get("/v1/jobs/" + id).header("ETag").value();
  EXPECT_EQ(get("/v1/jobs/" + id, {{"If-None-Match", etag}}).status, 304);
  const auto start_time = std::chrono::steady_clock::now();
  EXPECT_EQ(get("/v1/jobs/" + id, {{"If-None-Match", etag}, {"Prefer", "wait=1"}}).status, 304);
  EXPECT_GE(std::chrono::steady_clock::now() - start_time, 900ms);
  std::thread other = cancel_soon(id);
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
  std::thread other = cancel_soon(id);
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

}  // namespace
}  // namespace bahnwerk::server
