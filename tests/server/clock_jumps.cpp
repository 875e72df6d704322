// The time of day is set forward and back by a day while the service runs.
#include <gtest/gtest.h>

#include "service_fixture.hpp"

namespace bahnwerk::server {
namespace {

struct ClockJumps : ServiceTest {
  std::vector<std::string> listed() const {
    std::vector<std::string> ids;
    const json page = json::parse(get("/v1/jobs").body);
    for (const json& job : page["jobs"]) ids.push_back(job["id"]);
    return ids;
  }
  /// Lets the threads that sleep on the steady clock look at the time of day again.
  template <class Condition>
  bool soon_after_a_look(Condition condition) {
    return soon([&] {
      time.advance(1s);
      return condition();
    });
  }
  bool there(const std::string& id) const { return get("/v1/jobs/" + id).status == 200; }
};

TEST_F(ClockJumps, RunningPlansAndWaitsGoOn) {
  start_with_manual_time();
  const std::string id = posted(R"({"forever":true})");
  await(id, "running");
  auto waiter = held("/v1/jobs/" + id, {{"Prefer", "wait=30"}});
  for (const auto jump : {24h, -48h, 24h}) {
    time.set_clock(jump);
    await_progress(id);
    EXPECT_FALSE(is_ready(waiter));
    const json job = json::parse(get("/v1/jobs/" + id).body);
    EXPECT_EQ(job["state"], "running");
    EXPECT_EQ(job["attempt"], 1) << "its lease does not depend on the time of day";
  }
  cancel(id);
  await(id, "cancelled");
  EXPECT_EQ(json::parse(taken(waiter).body)["state"], "cancelled");
}

TEST_F(ClockJumps, IdsStayInOrderAndIdempotencyKeysHold) {
  options.workers = 0;
  start_with_manual_time();
  std::vector<std::string> ids{posted("{}")};
  const std::string first = json::parse(post("{}", {{"Idempotency-Key", "k"}}).body)["id"];
  ids.insert(ids.begin(), first);
  for (const auto jump : {-24h, 48h, -48h}) {
    time.set_clock(jump);
    ids.insert(ids.begin(), posted("{}"));
    EXPECT_EQ(json::parse(post("{}", {{"Idempotency-Key", "k"}}).body)["id"], first);
    EXPECT_EQ(post(R"({"rows":3})", {{"Idempotency-Key", "k"}}).status, 409);
    EXPECT_EQ(listed(), ids) << "newest first";
  }
  EXPECT_TRUE(std::is_sorted(ids.rbegin(), ids.rend()));
}

TEST_F(ClockJumps, DeadlinesAreTimesOfDay) {
  options.workers = 0;
  start_with_manual_time();
  const std::string id = posted(R"({"deadline_in":3600000})");
  time.set_clock(-24h);
  time.advance(30s);
  EXPECT_EQ(json::parse(get("/v1/jobs/" + id).body)["state"], "queued");
  time.set_clock(48h);
  EXPECT_TRUE(soon_after_a_look([&] { return json::parse(get("/v1/jobs/" + id).body)["state"] == "failed"; }));
}

TEST_F(ClockJumps, RetentionRemovesWhatEndedLongAgoByTheClockThatIsSet) {
  options.retention.time = 3'600'000;
  start_with_manual_time();
  const std::string late = posted("{}");
  await(late, "succeeded");
  time.set_clock(-24h);
  const std::string early = posted("{}");
  await(early, "succeeded");
  time.advance(30s);
  EXPECT_TRUE(there(late)) << "it has ended in the future";
  time.set_clock(24h);
  EXPECT_TRUE(soon_after_a_look([&] { return !there(early); })) << "it ended a day ago";
  EXPECT_TRUE(there(late));
  time.set_clock(24h);
  EXPECT_TRUE(soon_after_a_look([&] { return !there(late); }));
}

}  // namespace
}  // namespace bahnwerk::server
