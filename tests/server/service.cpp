/// The service from socket to store, with a stub in the place of parser and planner. Waiting and following:
/// service_waiting.cpp.
#include "server/service.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <new>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "core/base/errors.hpp"
#include "server/http/http_client.hpp"
#include "server/runtime/clock.hpp"
#include "service_fixture.hpp"

namespace bahnwerk::server {
namespace {

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

TEST_F(ServiceTest, EndsAQueuedJobAtItsDeadline) {
  options.workers = 0;
  start_with_manual_time();
  const std::string id = posted(R"({"deadline_in":300})");
  auto answer = held("/v1/jobs/" + id, {{"Prefer", "wait=60"}});
  time.advance(299ms);
  EXPECT_EQ(json::parse(get("/v1/jobs/" + id).body)["state"], "queued");
  time.advance(1ms);
  const json job = json::parse(taken(answer).body);
  EXPECT_EQ(job["state"], "failed");
  EXPECT_EQ(job["error"]["type"], "/problems/deadline-exceeded");
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
        } catch (const Unreachable&) {
          return;
        }
      }
    });
  clients.emplace_back([&] {
    try {
      get("/v1/jobs/" + forever + "?", {{"Prefer", "wait=60"}});
      while (!stop) get("/v1/jobs/" + forever, {{"Prefer", "wait=60"}});
    } catch (const Unreachable&) {
    }
  });
  EXPECT_TRUE(soon([&] { return accepted >= 8; }));
  EXPECT_EQ(service->drain(), Service::Drained::clean);
  stop = true;
  service.reset();
  for (auto& thread : clients) thread.join();
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
            } catch (const Unreachable&) {  // deleted by its own client meanwhile: the answer breaks off
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
  options.stop_patience = 30s;
  options.answer_patience = 100ms;  // too little for a check that has not ended
  std::atomic<bool> checking{false}, over{false};
  Engine engine = stub_engine();
  engine.parse = [&, parse = engine.parse](std::string_view body, Progress progress) {
    if (body == R"({"slow":true})") {
      checking = true;
      while (!over) std::this_thread::sleep_for(1ms);
    }
    return parse(body, progress);
  };
  service = std::make_unique<Service>(options, std::move(engine));
  client = std::make_unique<HttpClient>("http://" + service->address());
  await(posted(R"({"forever":true})"), "running");
  std::thread checked([&] {  // nothing can stop a check
    try {
      HttpClient("http://" + service->address())
          .request("POST", "/v1/jobs", {{"Content-Type", "application/json"}}, R"({"slow":true})");
    } catch (const Unreachable&) {
    }
  });
  EXPECT_TRUE(soon([&] { return checking.load(); }));
  EXPECT_EQ(service->drain(), Service::Drained::late) << "it does not wait for the check";
  over = true;
  service.reset();  // waits for the check; the process would not
  checked.join();
}

TEST_F(ServiceTest, TellsThatAPlannerDidNotStop) {
  options.drain_timeout = 10ms;
  options.stop_patience = 50ms;
  std::atomic<bool> planning{false}, over{false};
  Engine engine = stub_engine();
  engine.plan = [&](const std::string&, const std::string&, Progress) -> api::PlannedJob {
    planning = true;
    while (!over) std::this_thread::sleep_for(1ms);
    throw Infeasible("in the end");
  };
  service = std::make_unique<Service>(options, std::move(engine));
  client = std::make_unique<HttpClient>("http://" + service->address());
  posted("{}");
  EXPECT_TRUE(soon([&] { return planning.load(); }));
  EXPECT_EQ(service->drain(), Service::Drained::stuck);
  over = true;
  service.reset();  // waits for the planner; the process would not
}

TEST_F(ServiceTest, LooksAtJobsWhileDocumentsAreChecked) {
  std::atomic<bool> over{false};
  std::atomic<int> checking{0}, checked{0}, answered{0};
  Engine engine = stub_engine();
  engine.parse = [&, parse = engine.parse](std::string_view body, Progress progress) {
    if (body == R"({"slow":true})") {
      ++checking;
      while (!over) std::this_thread::sleep_for(1ms);
      ++checked;
    }
    return parse(body, progress);
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
  EXPECT_TRUE(soon([&] { return checking > 0; })) << "documents are being checked";
  await(id, "succeeded");
  EXPECT_EQ(get("/readyz").status, 200);
  EXPECT_EQ(checked, 0);
  EXPECT_EQ(answered, 0);
  over = true;
  for (auto& thread : posters) thread.join();
  EXPECT_EQ(checked, 16);
}

/// Asks `progress` until it stops the check, which takes processor time; returns the request as not checked.
api::JobRequest checked_for_ever(Progress progress, api::JobRequest request) {
  try {
    for (;;) progress.report("read", 0);
  } catch (const Stopped&) {
    request.checked = false;
  }
  return request;
}

TEST_F(ServiceTest, LongChecksEndAndNeverHoldAShortOne) {
  Engine engine = stub_engine(time);
  std::atomic<int> begun{0};
  engine.parse = [&, parse = engine.parse](std::string_view body, Progress progress) {
    api::JobRequest request = parse(body, progress);
    if (body != R"({"long":true})") return request;
    ++begun;
    return checked_for_ever(progress, std::move(request));
  };
  options.workers = 0;
  service = std::make_unique<Service>(options, std::move(engine), time);
  client = std::make_unique<HttpClient>("http://" + service->address());
  std::vector<std::future<int>> long_posts;
  for (int i = 0; i < 4; ++i)
    long_posts.push_back(std::async(std::launch::async, [&] {
      return HttpClient("http://" + service->address())
          .request("POST", "/v1/jobs", {{"Content-Type", "application/json"}}, R"({"long":true})")
          .status;
    }));
  EXPECT_TRUE(soon([&] { return begun >= 5; })) << "each begins beside the others, and again in its turn";
  for (int i = 0; i < 20; ++i) EXPECT_EQ(post("{}").status, 202) << "while time stands still for the long ones";
  EXPECT_TRUE(soon([&] {  // in their turn they have two seconds
    time.advance(100ms);
    return std::all_of(long_posts.begin(), long_posts.end(),
                       [](auto& answer) { return answer.wait_for(0s) == std::future_status::ready; });
  }));
  for (auto& answer : long_posts) EXPECT_EQ(answer.get(), 202) << "what was not checked is accepted";
}

TEST_F(ServiceTest, TheCheckThatWasStoppedIsTheBeginOfThePlan) {
  Engine engine = stub_engine();
  engine.parse = [parse = engine.parse](std::string_view body, Progress progress) {
    return checked_for_ever(progress, parse(body, progress));
  };
  engine.check = [](std::string_view, Progress) { throw api::Problem("semantic-violation", "found late"); };
  service = std::make_unique<Service>(options, std::move(engine));
  client = std::make_unique<HttpClient>("http://" + service->address());
  const json job = await(posted(R"({"long":true})"), "failed");
  EXPECT_EQ(job["error"]["type"], "/problems/semantic-violation");
  EXPECT_EQ(job["error"]["detail"], "found late");
}

TEST_F(ServiceTest, ACheckWithoutMemoryIsRefusedWithASentence) {
  Engine engine = stub_engine();
  engine.parse = [](std::string_view, Progress) -> api::JobRequest { throw std::bad_alloc(); };
  service = std::make_unique<Service>(options, std::move(engine));
  client = std::make_unique<HttpClient>("http://" + service->address());
  const Response answer = post("{}");
  EXPECT_EQ(answer.status, 422);
  EXPECT_EQ(json::parse(answer.body)["type"], "/problems/semantic-violation");
  EXPECT_EQ(get("/readyz").status, 200);
}

TEST_F(ServiceTest, LongTextsAreSentInPiecesWithTheirLength) {
  options.workers = 0;
  start();
  std::string text = "{\"n\":[";
  while (text.size() < 1'000'000) text += std::to_string(text.size()) + ",";
  text += "0]}";
  const std::string spec = "/v1/jobs/" + posted(text) + "/spec";
  const Response whole = get(spec);
  EXPECT_EQ(whole.body, text);
  EXPECT_EQ(whole.header("Content-Length"), std::to_string(text.size()));
  const Response known = get(spec, {{"If-None-Match", *whole.header("ETag")}});
  EXPECT_EQ(known.status, 304);
  EXPECT_EQ(known.body, "");
  EXPECT_EQ(known.header("ETag"), whole.header("ETag"));
}

TEST_F(ServiceTest, EndsWithoutADrain) {
  start();
  const std::string id = posted(R"({"forever":true})");
  await(id, "running");
  auto waiter = held("/v1/jobs/" + id, {{"Prefer", "wait=60"}});
  service.reset();  // neither the job, which never ends, nor the waiter holds it up
  EXPECT_EQ(waiter.wait_for(30s), std::future_status::ready);
  options.workers = 0;
  start();
  EXPECT_EQ(json::parse(get("/v1/jobs/" + id).body)["state"], "queued") << "the job is taken up again";
}

TEST_F(ServiceTest, AnswersAProbeWhenItsThreadsTurn) {
  start();
  std::promise<void> answered;
  service->probe([&] { answered.set_value(); });
  answered.get_future().get();
  service.reset();
  options.http_threads = 0;
  service = std::make_unique<Service>(options, stub_engine());
  bool called = false;
  service->probe([&] { called = true; });
  service->drain();
  service.reset();
  EXPECT_FALSE(called) << "no socket thread turned";
}

TEST_F(ServiceTest, SaysWhichBuildItIs) {
  options.build = {"1.2.3", "0123456789ab", "Release, X 1, -O9"};
  start();
  EXPECT_EQ(
      json::parse(get("/healthz").body),
      (json{{"status", "alive"}, {"version", "1.2.3"}, {"commit", "0123456789ab"}, {"build", "Release, X 1, -O9"}}));
}

TEST_F(ServiceTest, MeasuresTheStoreAndItsQueue) {
  options.workers = 0;
  start_with_manual_time();
  posted("{}");
  time.advance(7s);
  posted("{}");
  const std::string text = get("/metrics").body;
  for (const std::string line :
       {"bahnwerk_queue_length 2", "bahnwerk_queue_oldest_seconds 7", "bahnwerk_queue_beyond_engine 0",
        "bahnwerk_store_state{state=\"up\"} 1", "bahnwerk_store_state{state=\"away\"} 0",
        "bahnwerk_store_connections_max 0", "bahnwerk_claim_seconds_count 0"})
    EXPECT_NE(text.find('\n' + line + '\n'), std::string::npos) << line;
}

TEST_F(ServiceTest, MeasuresWhileItsStoreIsAway) {
  options.store = "postgresql://nobody@/none?host=" + folder.path.string();
  start();
  EXPECT_EQ(get("/readyz").status, 503);
  const Response metrics = get("/metrics");
  EXPECT_EQ(metrics.status, 200);
  for (const std::string line :
       {"bahnwerk_store_state{state=\"away\"} 1", "bahnwerk_store_state{state=\"up\"} 0", "bahnwerk_queue_length Nan",
        "bahnwerk_jobs{state=\"running\"} Nan", "bahnwerk_store_bytes Nan", "bahnwerk_workers 2",
        "bahnwerk_feed_caught_up_timestamp_seconds Nan"})
    EXPECT_NE(metrics.body.find('\n' + line + '\n'), std::string::npos) << line;
}

TEST_F(ServiceTest, SaysWhyItCannotStart) {
  start();
  ServiceOptions second = options;
  second.listen = service->address();
  second.store = "sqlite:" + (folder.path / "other.db").string();
  EXPECT_THROW(Service(second, stub_engine()), std::runtime_error);
  second.listen = "nonsense";
  EXPECT_THROW(Service(second, stub_engine()), std::runtime_error);
  second.store = "postgresql:x";
  EXPECT_THROW(Service(second, stub_engine()), StoreError);
}

}  // namespace
}  // namespace bahnwerk::server
