/// Clients that wait for a job and follow it, with a stub in the place of parser and planner.
#include <atomic>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "api/problem.hpp"
#include "server/http/http_client.hpp"
#include "server/runtime/clock.hpp"
#include "server/service.hpp"
#include "service_fixture.hpp"

namespace bahnwerk::server {
namespace {

TEST_F(ServiceTest, HoldsAnAnswerUntilTheJobChanges) {
  options.workers = 0;
  start_with_manual_time();
  const std::string id = posted("{}");
  const std::string etag = get("/v1/jobs/" + id).header("ETag").value();
  EXPECT_EQ(get("/v1/jobs/" + id, {{"If-None-Match", etag}}).status, 304);
  auto unchanged = held("/v1/jobs/" + id, {{"If-None-Match", etag}, {"Prefer", "wait=1"}});
  time.advance(500ms);
  let_a_second_pass(unchanged);
  EXPECT_EQ(taken(unchanged).status, 304);
  auto changed = held("/v1/jobs/" + id, {{"Prefer", "wait=60"}});
  EXPECT_FALSE(is_ready(changed));
  cancel(id);
  EXPECT_EQ(json::parse(taken(changed).body)["state"], "cancelled");
}

TEST_F(ServiceTest, HoldsAnAnswerForTheWholeTime) {
  options.workers = 0;
  start();
  const std::string id = posted("{}");
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(get("/v1/jobs/" + id, {{"Prefer", "wait=1"}}).status, 200);
  EXPECT_GE(std::chrono::steady_clock::now() - began, 1s);
}

TEST_F(ServiceTest, WaitsForTheEndWithoutIfNoneMatch) {
  start_with_manual_time();
  const std::string id = posted(R"({"forever":true})");
  await(id, "running");
  auto held_for_a_second = held("/v1/jobs/" + id, {{"Prefer", "wait=1"}});
  for (int i = 0; i < 5; ++i) await_progress(id);
  EXPECT_FALSE(is_ready(held_for_a_second)) << "progress is not the end";
  let_a_second_pass(held_for_a_second);
  const Response running = taken(held_for_a_second);
  EXPECT_EQ(json::parse(running.body)["state"], "running");
  EXPECT_EQ(running.header("Preference-Applied"), "wait=1");
  auto ended = held("/v1/jobs/" + id, {{"Prefer", "wait=60"}});
  cancel(id);
  EXPECT_EQ(json::parse(taken(ended).body)["state"], "cancelled");
  // It answers at once when the job has ended: the time stands still.
  EXPECT_EQ(json::parse(get("/v1/jobs/" + id, {{"Prefer", "wait=60"}}).body)["state"], "cancelled");
}

TEST_F(ServiceTest, ProgressAnswersAWaiterOnceASecond) {
  start_with_manual_time();
  const std::string id = posted(R"({"forever":true})");
  await(id, "running");
  await_progress(id);
  std::string etag = get("/v1/jobs/" + id).header("ETag").value();
  for (const bool old : {false, true}) {
    if (old) await_progress(id);  // the ETag is old when the client comes
    auto answer = held("/v1/jobs/" + id, {{"If-None-Match", etag}, {"Prefer", "wait=60"}});
    for (int i = 0; i < 5; ++i) await_progress(id);
    EXPECT_FALSE(is_ready(answer)) << "progress is told once a second";
    let_a_second_pass(answer);
    const Response response = taken(answer);
    EXPECT_EQ(response.status, 200);
    EXPECT_NE(response.header("ETag"), etag);
    etag = response.header("ETag").value_or("");
  }
  // Without waiting, every look shows what is new.
  EXPECT_EQ(get("/v1/jobs/" + id, {{"If-None-Match", "\"1\""}}).status, 200);
  // A change of state is told at once, also to who comes late: the time stands still.
  EXPECT_EQ(get("/v1/jobs/" + id, {{"If-None-Match", "\"1\""}, {"Prefer", "wait=60"}}).status, 200);
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

/// Follows a job's events to their end; `piece` is called with each piece of text as it comes.
Response follow_events(const HttpClient& client, const std::string& id,
                       const std::function<void(std::string_view)>& piece) {
  std::string text;
  Response response = client.request("GET", "/v1/jobs/" + id + "/events", {}, {}, [&](std::string_view part) {
    text += part;
    piece(part);
  });
  response.body = text;
  return response;
}

TEST_F(ServiceTest, StreamsEventsToTheEnd) {
  start_with_manual_time();
  const std::string id = posted(R"({"forever":true})");
  await(id, "running");
  std::atomic<int> begun{0}, progressed{0};
  auto answer = std::async(std::launch::async, [&] {
    return follow_events(*client, id, [&](std::string_view text) {
      ++begun;
      if (text.find("event: progress") != text.npos) ++progressed;
    });
  });
  EXPECT_TRUE(soon([&] { return begun > 0; }));
  for (int i = 0; i < 9; ++i) await_progress(id);
  time.advance(99ms);
  EXPECT_EQ(progressed, 0) << "at most once a second";
  time.advance(1ms);
  EXPECT_TRUE(soon([&] { return progressed == 1; }));
  await_progress(id);
  EXPECT_EQ(progressed, 1);
  cancel(id);
  const Response response = taken(answer);
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
  EXPECT_EQ(progress, 1);

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
  std::atomic<int> begun{0}, ended{0};
  std::vector<std::thread> clients;
  const auto before = threads();
  for (int i = 0; i < 100; ++i)
    clients.emplace_back([&] {
      bool first = true;
      const Response response =
          follow_events(*client, id, [&](std::string_view) { begun += std::exchange(first, false); });
      EXPECT_FALSE(parse_events(response.body).empty());
      ++ended;
    });
  EXPECT_TRUE(soon([&] { return begun == 100; }));
  EXPECT_LE(threads() - before, 100) << "the clients' own";
  EXPECT_EQ(get("/healthz").status, 200);
  EXPECT_EQ(ended, 0);
  EXPECT_EQ(service->drain(), Service::Drained::clean);
  for (auto& thread : clients) thread.join();
  EXPECT_EQ(ended, 100);
}

TEST_F(ServiceTest, AJobThatCannotEndInItsTimeIsRefusedAndALongOneIsNoted) {
  Engine engine = stub_engine();
  engine.parse = [parse = engine.parse](std::string_view body, Progress progress) {
    api::JobRequest request = parse(body, progress);
    const json document = json::parse(body);
    if (document.contains("takes"))
      request.planning_time = api::PlanningTime{document["takes"], "/spec/effort", "effort shorten it"};
    if (document.contains("budget")) request.time_budget = document["budget"];
    return request;
  };
  options.workers = 0;
  options.max_planning = 100s;
  service = std::make_unique<Service>(options, std::move(engine));
  client = std::make_unique<HttpClient>("http://" + service->address());
  EXPECT_FALSE(json::parse(post(R"({"takes":59})").body).contains("notes"));
  for (const char* body : {R"({"takes":60})", R"({"takes":300})"}) {
    const Response answer = post(body);
    EXPECT_EQ(answer.status, 202) << body;
    EXPECT_EQ(json::parse(answer.body)["notes"].size(), 1u) << body;
  }
  for (const char* body : {R"({"takes":301})", R"({"takes":31,"budget":10})"}) {
    const Response answer = post(body);
    EXPECT_EQ(answer.status, 422) << body;
    const json problem = json::parse(answer.body);
    EXPECT_EQ(problem["type"], "/problems/semantic-violation");
    EXPECT_EQ(problem["errors"][0]["pointer"], "/spec/effort");
  }
}

}  // namespace
}  // namespace bahnwerk::server
