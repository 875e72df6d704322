#include "api/documents/job.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "api/text/json_text.hpp"
#include "api/text/rfc3339.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

TEST(ParseJob, ReadsEveryMember) {
  const auto request = parse_job(test::read_file(test::source("schemas/examples/job/complete.json")));
  EXPECT_EQ(request.kind, "contour");
  EXPECT_EQ(request.name, "bracket 12");
  EXPECT_EQ(request.reference, "WO-4711");
  EXPECT_EQ(request.priority, 5);
  EXPECT_EQ(request.deadline, parse_rfc3339("2026-01-31T11:00:00Z"));
  EXPECT_EQ(request.time_budget, 2.5);
  EXPECT_EQ(request.callback, (Callback{"https://example.com/done?job=12", "not to be shown"}));
  EXPECT_EQ(request.tags, (std::vector<std::string>{"steel", "line-2"}));
  EXPECT_EQ(job_spec(request.document), test::read_json(test::source("schemas/examples/job/complete.json"))["spec"]);
}

TEST(ParseJob, KeepsTheDocumentAsPostedButForTheSecret) {
  const std::string plain =
      R"("kind":"contour", "spec":{"contour":{"points":[[0,0],[100,0]]},"machine":{"axes":)"
      R"({"x":{"velocity":1800,"acceleration":16000},"y":{"velocity":1800,"acceleration":16000}}}} })";
  EXPECT_EQ(parse_job("{ " + plain).document, "{ " + plain);
  for (const std::string name : {R"("secret")", R"("\u0073ecret")"}) {
    const auto request = parse_job(R"({"callback":{"url":"http://a/b", )" + name + R"( : "a\"}b" }, )" + plain);
    EXPECT_EQ(request.callback->secret, "a\"}b");
    EXPECT_EQ(request.document, R"({"callback":{"url":"http://a/b", )" + name + " : null }, " + plain);
    EXPECT_EQ(parse_job(request.document).callback, (Callback{"http://a/b", std::nullopt}));
  }
}

TEST(ParseJob, KeepsEachTagOnce) {
  auto document = test::read_json(test::source("schemas/examples/job/minimal.json"));
  document["tags"] = {"b", "a", "b"};
  EXPECT_EQ(parse_job(document.dump()).tags, (std::vector<std::string>{"b", "a"}));
}

/// Stops a check at its n-th question.
struct StopsAt final : ProgressSink {
  explicit StopsAt(int n) : left(n) {}
  void report(std::string_view, double, std::string_view) override {
    if (--left <= 0) throw Stopped(StopReason::budget);
  }
  int left;
};

TEST(ParseJob, AStoppedCheckLeavesTheRequestUnchecked) {
  auto document = test::read_json(test::source("schemas/examples/job/minimal.json"));
  for (const int n : {1, 2, 1000}) {
    StopsAt progress(n);
    const auto request = parse_job(document.dump(), progress);
    EXPECT_EQ(request.checked, n == 1000);
    EXPECT_EQ(request.document, document.dump());
  }
  for (const auto& [member, value, slug] :
       {std::tuple<const char*, json, const char*>{"priority", "high", "schema-violation"},
        {"kind", "unheard", "unknown-kind"},
        {"callback", "https://example.org", "schema-violation"}}) {
    json faulty = document;
    faulty[member] = value;
    StopsAt progress(2);
    try {
      parse_job(faulty.dump(), progress);
      ADD_FAILURE() << "faults of the envelope are found all the same: " << member;
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.type().slug, slug);
    }
  }
}

/// Counts the questions before the stop and those after it.
struct StopsWhenTold final : ProgressSink {
  explicit StopsWhenTold(int n) : last(n) {}
  void report(std::string_view, double, std::string_view) override {
    if (++asked >= last) throw Stopped(StopReason::cancelled);
  }
  int last, asked = 0;
};

TEST(CheckJob, StopsAtAnyQuestionFromTheFirstByteOn) {
  std::string points = "[0,0]";
  for (int i = 1; i < 60'000; ++i) points += ",[" + std::to_string(i) + ".25,1.5]";
  const auto body = [&](const char* end) {
    return R"({"kind":"contour","spec":{"machine":{"axes":{"x":{"velocity":1000,"acceleration":1000},"y":{"velocity":1000,"acceleration":1000}}},
      "contour":{"points":[)" +
           points + end + "]}}}";
  };
  const std::string document = body("");
  StopsWhenTold all(std::numeric_limits<int>::max());
  check_job(document, all);
  const int values = 3 * 60'000;
  EXPECT_GE(all.asked, 2 * (values / 4096)) << "the text and the schema ask";
  for (int n = 1; n < all.asked; n += 7) {
    StopsWhenTold progress(n);
    EXPECT_THROW(check_job(document, progress), Stopped) << n;
    EXPECT_EQ(progress.asked, n) << "asked again after the stop";
  }
  // A fault at the end is explained, which takes longest, and asks as often.
  const std::string faulty = body(",[\"x\",0]");
  StopsWhenTold asked(std::numeric_limits<int>::max());
  EXPECT_THROW(check_job(faulty, asked), Problem);
  EXPECT_GE(asked.asked, 3 * (values / 4096));
  StopsWhenTold explaining(asked.asked);
  EXPECT_THROW(check_job(faulty, explaining), Stopped);
}

TEST(CheckJob, FindsWhatAStoppedCheckLeftOut) {
  auto document = test::read_json(test::source("schemas/examples/job/minimal.json"));
  Progress silent;
  EXPECT_NO_THROW(check_job(document.dump(), silent));
  document["spec"]["machine"]["axes"]["x"]["velocity"] = "fast";
  try {
    check_job(document.dump(), silent);
    FAIL();
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.type().slug, "schema-violation");
    EXPECT_EQ(test::pointers(problem), std::vector<std::string>{"/spec/machine/axes/x/velocity"});
  }
}

TEST(ParseJob, AbsentAndNullAreTheSame) {
  auto document = test::read_json(test::source("schemas/examples/job/minimal.json"));
  for (int pass = 0; pass < 2; ++pass) {
    const auto request = parse_job(document.dump());
    EXPECT_FALSE(request.name || request.reference || request.callback || request.deadline || request.time_budget);
    EXPECT_EQ(request.priority, 0);
    for (const char* key : {"name", "reference", "callback", "tags", "deadline", "time_budget"})
      document[key] = nullptr;
  }
}

TEST(ParseJob, TheSpecHasOneForm) {
  const auto spec = [](const char* number) {
    return job_spec(
               parse_job(
                   std::string(
                       R"({"kind":"contour","priority":1.0,"spec":{"machine":{"axes":{"y":{"acceleration":1,"velocity":1},
      "x":{"velocity":1e2,"acceleration":1}}},"contour":{"points":[[0,0],[)") +
                   number + R"(,0]]}}})")
                   .document)
        .dump();
  };
  EXPECT_EQ(spec("12"), spec("12.0"));
  EXPECT_EQ(spec("12"), spec("1.2e1"));
  EXPECT_NE(spec("12"), spec("12.5"));
}

TEST(ParseJob, RefusesABodyThatIsNoObject) {
  for (const char* body : {"[]", "null", "1", "\"contour\""}) {
    const auto problem = test::refusal(body);
    ASSERT_TRUE(problem) << body;
    EXPECT_EQ(problem->type().slug, "schema-violation");
    EXPECT_EQ(test::pointers(*problem), std::vector<std::string>{""});
  }
}

TEST(ParseJob, TenMegabytesAreReadOrRefusedInFewWords) {
  std::string points = "[0,0]";
  while (points.size() < 10'000'000)
    points += ",[" + std::to_string(points.size() % 1000) + ".25," + std::to_string(points.size() / 1000) + ".125]";
  const auto body = [&](const std::string& end) {
    return R"({"kind":"contour","spec":{"machine":{"axes":{"x":{"velocity":1000,"acceleration":1000},"y":{"velocity":1000,"acceleration":1000}}},
      "contour":{"points":[)" +
           points + end + "]}}}";
  };
  EXPECT_GT(parse_job(body("")).document.size(), 9'000'000u);
  const auto problem = test::refusal(body(",[\"x\",0]"));
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->errors().size(), 1u);
  const auto garbage = test::refusal("{\"kind\":\"" + std::string(10'000'000, 'k') + "\",\"spec\":{}}");
  ASSERT_TRUE(garbage);
  EXPECT_LT(garbage->document().dump().size(), 2000u);
  const auto keys = test::refusal("{\"" + std::string(10'000'000, 'k') + "\":1}");
  ASSERT_TRUE(keys);
}

Job sample() {
  Job job;
  job.id = "0190b6a4-0000-7000-8000-000000000001";
  job.request.kind = "contour";
  job.request.name = "bracket";
  job.created_at = 1769860800000;
  return job;
}

TEST(JobResource, HasTheMembersOfTheContractInOrder) {
  const auto resource = job_resource(sample());
  EXPECT_EQ(
      resource.dump(),
      R"({"id":"0190b6a4-0000-7000-8000-000000000001","kind":"contour","name":"bracket","reference":null,"priority":0,"deadline":null,)"
      R"("time_budget":null,"tags":[],"callback":null,"state":"queued",)"
      R"("progress":{"fraction":0.0,"stage":"","message":"","remaining":null},"queue":null,"attempt":0,"created_at":"2026-01-31T12:00:00.000Z","started_at":null,)"
      R"("finished_at":null,"planned_by":null,"error":null,"links":{"self":"/v1/jobs/0190b6a4-0000-7000-8000-000000000001",)"
      R"("spec":"/v1/jobs/0190b6a4-0000-7000-8000-000000000001/spec",)"
      R"("events":"/v1/jobs/0190b6a4-0000-7000-8000-000000000001/events",)"
      R"("result":"/v1/jobs/0190b6a4-0000-7000-8000-000000000001/result",)"
      R"("setpoints":"/v1/jobs/0190b6a4-0000-7000-8000-000000000001/setpoints",)"
      R"("cancel":"/v1/jobs/0190b6a4-0000-7000-8000-000000000001/cancel"}})");
}

TEST(JobResource, ShowsWhatIsKnown) {
  Job job = sample();
  job.request.deadline = 1769860800000;
  job.request.time_budget = 1.5;
  job.state = JobState::failed;
  job.attempt = 2;
  job.request.callback = Callback{"http://a/b", "secret"};
  job.request.tags = {"x"};
  job.delivery = {3, std::nullopt, 1769860801000, "answered 500"};
  job.started_at = 1769860801000;
  job.finished_at = 1769860802500;
  job.error = Problem("infeasible", "no way").document().dump();
  job.planned_by = "1.2.3";
  const auto resource = job_resource(job);
  EXPECT_FALSE(resource.contains("spec"));  // it may have megabytes
  EXPECT_EQ(resource["deadline"], "2026-01-31T12:00:00.000Z");
  EXPECT_EQ(resource["time_budget"], 1.5);
  EXPECT_EQ(resource["state"], "failed");
  EXPECT_EQ(resource["finished_at"], "2026-01-31T12:00:02.500Z");
  EXPECT_EQ(resource["error"]["type"], "/problems/infeasible");
  EXPECT_EQ(resource["planned_by"], "1.2.3");
  EXPECT_EQ(resource["tags"], nlohmann::ordered_json::array({"x"}));
  EXPECT_EQ(resource["callback"].dump(), R"({"url":"http://a/b","attempts":3,"delivered_at":null,)"
                                         R"("next_at":"2026-01-31T12:00:01.000Z","error":"answered 500"})");
}

TEST(JobState, NamesReadBack) {
  for (auto state : {JobState::queued, JobState::running, JobState::succeeded, JobState::failed, JobState::cancelled})
    EXPECT_EQ(job_state(to_string(state)), state);
  EXPECT_FALSE(job_state("done"));
  EXPECT_FALSE(job_state(""));
}

TEST(PlanJob, RefusesAnUnknownKind) {
  Progress progress;
  try {
    plan_job("knitting", "{}", progress);
    FAIL();
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.type().slug, "unknown-kind");
  }
}

}  // namespace
}  // namespace bahnwerk::api
