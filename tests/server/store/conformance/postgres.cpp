/// What the PostgreSQL store has beside what every store holds.
#include "server/runtime/clock.hpp"
#include "server/store/open.hpp"
#include "server/store/postgres/migrate.hpp"
#include "stores.hpp"

namespace bahnwerk::server {
namespace {

struct PostgresOnly : testing::Test {
  void SetUp() override {
    if (PostgresStores::missing()) GTEST_SKIP() << "its server is not installed";
    stores.emplace();
  }
  std::string run(const std::string& sql) {
    return PostgresServer::run(stores->url, "SET search_path = bahnwerk; " + sql);
  }
  std::optional<PostgresStores> stores;
  SilentProgress silent;
};

TEST_F(PostgresOnly, NumbersOfChangesGoOnWhereACrashHasEmptiedTheirTables) {
  Store& store = stores->one();
  insert_id(store);
  const std::uint64_t before = store.last_change();
  run("TRUNCATE changes, change_numbers, change_feed");
  EXPECT_GT(store.last_change(), before);
  const Changes changes = store.changes_since(before, 10);
  EXPECT_TRUE(changes.gap) << "all have to look";
  EXPECT_TRUE(changes.list.empty());
  const std::uint64_t after = stores->other().last_change();
  const std::string id = insert_id(store);
  ASSERT_EQ(stores->other().changes_since(after, 10).list.size(), 1U);
  EXPECT_EQ(stores->other().changes_since(after, 10).list.front().id, id);
}

TEST_F(PostgresOnly, AJobThatNeedsALaterEngineWaitsForOne) {
  PostgresOptions later{
      .url = stores->url, .patience = PostgresServer::patient(), .engine = 1, .times_of_callers = true};
  PostgresStore newer(later);
  const std::string id = insert_id(newer), plain = insert_id(stores->one());
  EXPECT_EQ(claim(stores->one(), 1)->id, plain);
  EXPECT_FALSE(claim(stores->one(), 1, "another"));
  EXPECT_EQ(claim(newer, 1, "third")->id, id);
}

TEST_F(PostgresOnly, JobsThatNeedALaterEngineAreCounted) {
  PostgresStore newer(
      {.url = stores->url, .patience = PostgresServer::patient(), .engine = 1, .times_of_callers = true});
  insert_id(newer);
  insert_id(newer);
  insert_id(stores->one());
  EXPECT_EQ(stores->one().status().beyond_engine, 2U);
  EXPECT_EQ(newer.status().beyond_engine, 0U);
}

TEST_F(PostgresOnly, AnOpenSnapshotAndWhatItKeepsAreMeasured) {
  Store& store = stores->one();
  const std::string id = insert_id(store);
  PostgresConnection reader(stores->url, PostgresServer::patient());
  reader.script("BEGIN ISOLATION LEVEL REPEATABLE READ; SET LOCAL idle_in_transaction_session_timeout = 0");
  reader.run("SELECT 1 FROM jobs LIMIT 1");
  const StoreStatus before = store.status();
  EXPECT_GT(before.snapshot_seconds, 0);
  for (int k = 0; k < 7; ++k) run("UPDATE jobs SET name = 'again'");
  const StoreStatus after = store.status();
  EXPECT_GE(after.snapshot_transactions, before.snapshot_transactions + 7);
  EXPECT_GT(after.snapshot_seconds, before.snapshot_seconds);
  // A session tells what it has done when it has ended, after its client's call.
  for (int k = 0; k < 6000 && store.status().dead_rows < 7; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_GE(store.status().dead_rows, 7);
  reader.rollback();
  EXPECT_LT(store.status().snapshot_transactions, after.snapshot_transactions);
}

TEST_F(PostgresOnly, ConnectionsAreCountedByUse) {
  Store& store = stores->one();
  insert_id(store);
  const StoreConnections connections = store.connections();
  EXPECT_EQ(connections.most, 6U) << "of eight, less those of leases and signals";
  EXPECT_GE(connections.idle + connections.busy, 1U);
  EXPECT_LE(connections.idle + connections.busy, 6U);
}

TEST_F(PostgresOnly, AnAttemptThatAClaimFindsLostIsTold) {
  std::vector<std::string> lost;
  PostgresStore store({.url = stores->url,
                       .patience = PostgresServer::patient(),
                       .lost = [&](const std::vector<std::string>& jobs) { lost = jobs; },
                       .times_of_callers = true});
  const std::string id = insert_id(store);
  ASSERT_TRUE(claim(stores->other(), 1000, "a", 500));
  EXPECT_FALSE(claim(store, 1499, "b", 500));
  EXPECT_TRUE(lost.empty());
  EXPECT_EQ(claim(store, 1500, "b", 500)->id, id);
  EXPECT_EQ(lost, std::vector{id});
  EXPECT_TRUE(store.expire(1600).lost.empty()) << "it is told once";
}

TEST_F(PostgresOnly, CountsAndAttemptsAgreeWithTheJobs) {
  Store& store = stores->one();
  for (int k = 0; k < 6; ++k) {
    NewJob job = new_job();
    if (k % 2 != 0) job.owner = "me";
    insert_id(store, job);
  }
  for (int k = 0; k < 4; ++k) claim(store, 1000, "w" + std::to_string(k), 500);
  const auto jobs = store.list({.state = api::JobState::running, .oldest_first = true});
  ASSERT_EQ(jobs.size(), 4U);
  EXPECT_TRUE(store.succeed({jobs[0].id, 1}, ramp_plan(10'000), 1100, 0, silent));
  EXPECT_TRUE(store.end({jobs[1].id, 1}, {.error = "{}", .now = 1100, .revision = 3}));
  EXPECT_TRUE(store.requeue({jobs[2].id, 1}, 1100, 0));
  EXPECT_EQ(store.expire(1500).lost, std::vector{jobs[3].id});
  store.remove(jobs[1].id);
  EXPECT_EQ(inspect(stores->url), std::vector<std::string>{});
  run("UPDATE count_deltas SET jobs = jobs + 1 WHERE state = 'succeeded'");
  run("DELETE FROM chunks WHERE first_row = 0");
  EXPECT_EQ(inspect(stores->url).size(), 2U);
}

TEST_F(PostgresOnly, WhatACommandOffersIsRefusedWhereTheServerHasItsOwn) {
  EXPECT_THROW(back_up(stores->url, "/tmp/never"), StoreError);
}

TEST_F(PostgresOnly, KeysAreAddedListedAndRemovedBesideTheStore) {
  Key key;
  key.id = "id";
  key.name = "acme";
  key.scopes.submit = true;
  key.hash = "hash";
  key.created_at = 5;
  add_key(stores->url, key);
  const auto keys = stores->one().keys(0);
  ASSERT_TRUE(keys);
  ASSERT_EQ(keys->list.size(), 1U);
  EXPECT_EQ(keys->list[0].name, "acme");
  EXPECT_EQ(keys->list[0].created_at, 5);
  EXPECT_FALSE(stores->other().keys(keys->version));
  EXPECT_EQ(remove_keys(stores->url, "acme").size(), 1U);
  EXPECT_TRUE(stores->other().keys(keys->version)->list[0].removed_at);
  EXPECT_EQ(list_keys(stores->url).size(), 1U);
}

TEST_F(PostgresOnly, AStoreThatNeedsANewerProgramIsRefused) {
  run("INSERT INTO schema_version VALUES (1000, 1)");
  EXPECT_NO_THROW(stores->restart()) << "it is newer, and this program may use it";
  run("UPDATE schema_version SET min_reader = 1000 WHERE version = 1000");
  EXPECT_THROW(PostgresStore({.url = stores->url}), StoreError);
}

TEST_F(PostgresOnly, TextsThatAreNoUtf8AreKeptReadable) {
  NewJob job = new_job();
  job.request.name = "caf\xC3 caf\xC3\xA9";
  const std::string id = insert_id(stores->one(), job);
  EXPECT_EQ(stores->one().get(id)->request.name, "caf? caf\xC3\xA9");
}

TEST_F(PostgresOnly, AConnectionThatTheServerEndsIsReplaced) {
  Store& store = stores->one();
  const std::string id = insert_id(store);
  run("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'bahnwerk'");
  EXPECT_TRUE(store.get(id));
  EXPECT_TRUE(claim(store, 1));
}

TEST_F(PostgresOnly, EachDayHasItsPartition) {
  EXPECT_EQ(run("SELECT count(*) >= 4 FROM pg_inherits WHERE inhparent = 'chunks'::regclass"), "t");
  NewJob job = new_job();
  job.now = now_ms();
  const std::string id = insert_id(stores->one(), job);
  EXPECT_NE(run("SELECT tableoid::regclass FROM specs WHERE id = '" + id + "'"), "specs_rest");
  EXPECT_TRUE(claim(stores->other(), 1));
}

TEST_F(PostgresOnly, ErrorsOfTheServerAreSentencesWithoutPasswords) {
  try {
    PostgresConnection("postgresql://postgres:secret@/none?host=" + std::string("/nowhere"));
    ADD_FAILURE();
  } catch (const StoreAway& error) {
    EXPECT_EQ(std::string(error.what()).find("secret"), std::string::npos);
  }
  PostgresConnection connection(stores->url, PostgresServer::patient());
  EXPECT_THROW(connection.run("SELECT 1 / 0"), StoreError);
  EXPECT_EQ(connection.run("SELECT 7").integer(0, 0), 7) << "the connection is of use after an error";
  EXPECT_THROW(connection.run_all({{"SELECT 8"}, {"SELECT nothing"}, {"SELECT 9"}}), StoreError);
  EXPECT_EQ(connection.run("SELECT 9").integer(0, 0), 9);
  connection.begin();
  EXPECT_THROW(connection.run("SELECT 1 / 0"), StoreError);
  connection.rollback();
  EXPECT_TRUE(connection.idle());
}

TEST_F(PostgresOnly, ACallEndsAtItsDeadline) {
  PostgresConnection connection(stores->url,
                                {.brief = std::chrono::minutes(5), .lengthy = std::chrono::milliseconds(50)});
  EXPECT_THROW(connection.run_lengthy("SELECT 1 FROM pg_sleep(3600)"), StoreAway);
  EXPECT_TRUE(connection.broken());
}

}  // namespace
}  // namespace bahnwerk::server
