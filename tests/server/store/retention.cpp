/// What a store keeps of ended jobs, and the room that it gives back.
#include <filesystem>
#include <random>

#include "fixture.hpp"

namespace bahnwerk::server {
namespace {

struct RetentionTest : testing::Test {
  void open(Retention retention) {
    store.reset();
    store = std::make_unique<SqliteStore>(SqliteOptions{.path = path(), .retention = retention});
  }
  std::string path() const { return (folder.path / "store.db").string(); }
  /// A job that ended at `now` with that many rows of setpoints.
  std::string ended(std::int64_t now, std::size_t rows = 0) {
    const std::string id = insert_id(*store);
    const auto job = store->claim({"w", now, Lease::forever});
    EXPECT_EQ(job->id, id);
    auto planned = ramp_plan(rows);
    std::string noise;  // else a row takes next to nothing
    while (noise.size() < rows / 2) noise += std::to_string(random());
    planned.result["noise"] = noise;
    EXPECT_TRUE(store->succeed({id, 1}, planned, now, nothing_seen, silent));
    return id;
  }
  std::vector<std::string> ids() {
    std::vector<std::string> list;
    for (const auto& job : store->list({.limit = 1000})) list.push_back(job.id);
    return list;
  }
  /// Calls expire until it has nothing more to do; returns how many jobs it removed.
  std::size_t settle(std::int64_t now) {
    std::size_t removed = 0;
    for (int calls = 0; calls < 10'000; ++calls) {
      const Expired expired = store->expire(now);
      removed += expired.removed;
      if (!expired.next || *expired.next > now) return removed;
    }
    ADD_FAILURE() << "expire has no end";
    return removed;
  }
  TempFolder folder;
  std::unique_ptr<SqliteStore> store;
  Progress silent;
  std::mt19937_64 random;
};

TEST_F(RetentionTest, ForEverUnlessToldOtherwise) {
  open({});
  ended(1);
  EXPECT_EQ(settle(std::int64_t{1} << 50), 0U);
  EXPECT_EQ(ids().size(), 1U);
}

TEST_F(RetentionTest, ByTimeSinceTheEndAndNothingThatHasNotEnded) {
  open({.time = 1000});
  const std::string early = ended(10), late = ended(500), queued = insert_id(*store);
  EXPECT_EQ(settle(1009), 0U);
  EXPECT_EQ(settle(1010), 1U);
  EXPECT_EQ(ids(), (std::vector<std::string>{queued, late}));
  store->claim({"w", 600, Lease::forever});
  EXPECT_EQ(settle(1'000'000), 1U);
  EXPECT_EQ(ids(), std::vector<std::string>{queued}) << "a running job stays";
}

TEST_F(RetentionTest, ByNumberTheLatestEndsStay) {
  open({.jobs = 3});
  for (int i = 0; i < 200; ++i) ended(1000 - i);  // what was posted last has ended first
  const auto all = ids();
  EXPECT_EQ(settle(2000), 197U);
  EXPECT_EQ(ids(), (std::vector<std::string>(all.end() - 3, all.end())));
  EXPECT_EQ(store->counts(std::nullopt)[api::JobState::succeeded], 3U);
}

TEST_F(RetentionTest, ByBytesTheFileShrinks) {
  open({.spare_bytes = 0});
  for (int i = 0; i < 8; ++i) ended(i, 300'000);
  store->checkpoint();
  const auto full = std::filesystem::file_size(path());
  const auto half = static_cast<std::int64_t>(full / 2);
  open({.bytes = half, .spare_bytes = 0});
  const std::size_t removed = settle(100);
  EXPECT_GE(removed, 3U);
  EXPECT_LE(removed, 5U) << "no more than needed";
  store->checkpoint();
  EXPECT_LE(std::filesystem::file_size(path()), static_cast<std::uintmax_t>(half));
  EXPECT_EQ(settle(100), 0U);
}

TEST_F(RetentionTest, SpareRoomIsKeptForTheNextJobs) {
  open({.jobs = 1});
  for (int i = 0; i < 4; ++i) ended(i, 300'000);
  store->checkpoint();
  const auto full = std::filesystem::file_size(path());
  EXPECT_EQ(settle(100), 3U);
  store->checkpoint();
  EXPECT_EQ(std::filesystem::file_size(path()), full) << "fewer than 16 MiB are free";
}

TEST_F(RetentionTest, AJobOfManyIsCancelledOrRemovedByItsFilter) {
  open({});
  const auto post = [&](const std::string& reference, std::int64_t now) {
    NewJob job = new_job();
    job.request.reference = reference;
    job.now = now;
    return insert_id(*store, std::move(job));
  };
  std::vector<std::string> old, young;
  for (int i = 0; i < 600; ++i) old.push_back(post(i % 2 ? "odd" : "even", 1'700'000'000'000 + i));
  const std::string running = store->claim({"w", 1, Lease::forever})->id;
  young.push_back(post("odd", 1'700'001'000'000));
  EXPECT_EQ(store->cancel_all({.reference = "odd", .created_before = 1'700'001'000'000}, 5), 300U);
  EXPECT_EQ(store->cancel_all({.reference = "odd", .created_before = 1'700'001'000'000}, 6), 0U);
  EXPECT_EQ(store->get(young.front(), false)->state, api::JobState::queued);
  EXPECT_EQ(store->cancel_all({.state = api::JobState::succeeded}, 7), 0U);
  EXPECT_EQ(store->cancel_all({.state = api::JobState::running}, 7), 1U);
  EXPECT_TRUE(store->cancel_requested(running));
  EXPECT_EQ(store->remove_all({.state = api::JobState::cancelled}), 300U);
  EXPECT_EQ(store->remove_all({.created_after = 1'700'001'000'000}), 1U);
  EXPECT_EQ(store->remove_all({}), 299U) << "but for the running one";
  EXPECT_EQ(ids(), std::vector<std::string>{running});
}

}  // namespace
}  // namespace bahnwerk::server
