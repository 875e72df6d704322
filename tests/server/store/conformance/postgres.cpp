/// What the PostgreSQL store has beside what every store holds.
#include <algorithm>
#include <functional>
#include <random>
#include <set>
#include <thread>

#include "../postgres_wire.hpp"
#include "server/runtime/clock.hpp"
#include "server/store/open.hpp"
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
  Progress silent;
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

/// What a reader has seen: the number and the job of each change, in order.
using Seen = std::vector<std::pair<std::uint64_t, std::string>>;

/// Asks for changes until none are left after `writing` has become 0.
Seen follow(Store& store, std::uint64_t sequence, const std::atomic<int>& writing) {
  Seen seen;
  for (bool last = false; !last;) {
    last = writing == 0;
    const Changes changes = store.changes_since(sequence, 7);
    EXPECT_FALSE(changes.gap);
    for (const Changed& changed : changes.list) {
      EXPECT_GT(changed.sequence, sequence);
      sequence = changed.sequence;
      seen.emplace_back(sequence, changed.id);
      last = false;
    }
  }
  return seen;
}

TEST_F(PostgresOnly, ChangesAreNumberedOnceInWhateverOrderTransactionsEnd) {
  constexpr int writers = 8, each = 60;
  const std::uint64_t start = stores->one().last_change();
  std::atomic<int> writing{writers + 1};
  std::mutex mutex;
  std::set<std::string> committed;
  /// One transaction that changes two jobs, made as each writer likes.
  const auto write = [&](PostgresConnection& connection, Uuid7& ids, bool keep, const std::function<void()>& between) {
    std::vector<std::string> made;
    connection.begin();
    for (int k = 0; k < 2; ++k) {
      made.push_back(ids.next(1'700'000'000'000));
      PostgresParameters id;
      id.uuid(made.back());
      connection.run_all(
          {{"INSERT INTO jobs (id, kind, rank, turn, needs, state, created_at) VALUES ($1, 'ramp', 0, 0, 0, "
            "'queued', now())",
            id},
           {"INSERT INTO changes (id) VALUES ($1)", id}});
      between();
    }
    if (!keep) return connection.rollback();
    connection.commit();
    const std::lock_guard lock(mutex);
    committed.insert(made.begin(), made.end());
  };
  std::vector<std::thread> threads;
  std::atomic<int> done{0};
  threads.emplace_back([&] {  // is open as long as any other one
    PostgresConnection connection(stores->url, PostgresServer::patient());
    connection.script("SET idle_in_transaction_session_timeout = 0");
    Uuid7 ids;
    write(connection, ids, true, [&] {
      while (done < writers) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
    --writing;
  });
  for (int t = 0; t < writers; ++t)
    threads.emplace_back([&, t] {
      PostgresConnection connection(stores->url, PostgresServer::patient());
      std::mt19937 draw(static_cast<unsigned>(t));
      Uuid7 ids;
      for (int k = 0; k < each; ++k)
        write(connection, ids, draw() % 8 != 0,
              [&] { std::this_thread::sleep_for(std::chrono::microseconds(draw() % 4 == 0 ? draw() % 20'000 : 0)); });
      ++done;
      --writing;
    });
  Seen first, second;
  std::thread reader([&] { second = follow(stores->other(), start, writing); });
  first = follow(stores->one(), start, writing);
  reader.join();
  for (std::thread& thread : threads) thread.join();
  std::set<std::string> seen;
  for (const auto& [number, id] : first) seen.insert(id);
  EXPECT_EQ(seen.size(), first.size()) << "none twice";
  EXPECT_EQ(seen, committed) << "and none missed";
  EXPECT_EQ(first, second) << "all processes see the same";
}

TEST_F(PostgresOnly, JobsThatNeedALaterEngineAreCounted) {
  PostgresStore newer({.url = stores->url,
                       .patience = PostgresServer::patient(),
                       .engine = api::engine_level + 1,
                       .times_of_callers = true});
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
  EXPECT_TRUE(store.succeed({jobs[0].id, 1}, ramp_plan(10'000), 1100, nothing_seen, silent));
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

TEST_F(PostgresOnly, WhatWasCommittedIsFoundWhereTheAnswerWasLost) {
  PostgresWire wire(stores->url);
  PostgresStore store({.url = wire.url(), .patience = PostgresServer::patient(), .times_of_callers = true});
  wire.part("INSERT INTO jobs");
  const Inserted inserted = insert(store, new_job(0, "key", "body"));
  EXPECT_EQ(wire.parted(), 1);
  EXPECT_EQ(inserted.what, Inserted::What::created);
  EXPECT_EQ(stores->one().list({}).size(), 1U);
  wire.part("INSERT INTO runs");
  EXPECT_THROW(claim(store, 1000, "w", 500), StoreAway);
  EXPECT_EQ(stores->one().get(inserted.id)->state, api::JobState::running);
  std::optional<api::Job> job;
  while (!job) try {
      job = claim(store, 1000, "w", 500);
    } catch (const StoreAway&) {  // the connections that the first loss made suspicious
    }
  EXPECT_EQ(job->id, inserted.id);
  EXPECT_EQ(job->attempt, 1) << "the claim was carried out, once";
  wire.part("UPDATE runs SET lease_until");
  EXPECT_EQ(store.heartbeat({"w", 1100, 1600}, {{{job->id, 1}, 0.5, "grid", "", 9}}).size(), 1U);
  wire.part("ended_by = $10");
  EXPECT_TRUE(store.end({job->id, 1}, {.error = "{}", .now = 1200, .revision = 9})) << "it has ended by this call";
  EXPECT_EQ(wire.parted(), 4);
  EXPECT_FALSE(store.end({job->id, 2}, {.error = "{}", .now = 1300, .revision = 9}));
  const std::string other = insert_id(store);
  const Attempt attempt{claim(store, 2000, "w", 500)->id, 1};
  EXPECT_EQ(attempt.id, other);
  wire.part("ended_by");
  EXPECT_TRUE(store.succeed(attempt, ramp_plan(10'000), 2100, nothing_seen, silent));
  EXPECT_EQ(wire.parted(), 5);
  EXPECT_EQ(stores->one().get(other)->state, api::JobState::succeeded);
  EXPECT_EQ(inspect(stores->url), std::vector<std::string>{});
}

/// A store that measures by the database's clock, as in the service.
struct ByItsClock {
  explicit ByItsClock(const std::string& url) : store({.url = url, .patience = PostgresServer::patient()}) {}
  /// Looks until the job is lost; returns how long that took since `from`.
  std::chrono::steady_clock::duration lost(const std::string& id, std::chrono::steady_clock::time_point from) {
    for (;;) {
      try {
        const auto ids = store.expire(now_ms()).lost;
        if (std::find(ids.begin(), ids.end(), id) != ids.end()) return std::chrono::steady_clock::now() - from;
      } catch (const StoreAway&) {  // connections whose end was not noticed yet
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  std::optional<api::Job> claim() { return store.claim({"dead", now_ms(), now_ms() + lease.count()}); }
  static constexpr std::chrono::milliseconds lease{700};
  PostgresStore store;
};

TEST_F(PostgresOnly, AfterAnOutageLeasesRunOutInAWholeLeaseAndTheirLossIsNotCounted) {
  ByItsClock by(stores->url);
  const std::string id = insert_id(by.store);
  ASSERT_TRUE(by.claim());
  run("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'bahnwerk'");
  const auto outage = std::chrono::steady_clock::now();
  EXPECT_GE(by.lost(id, outage), by.lease) << "whoever lives renews first";
  EXPECT_EQ(run("SELECT losses FROM jobs"), "0") << "the worker may have been cut off";
  EXPECT_EQ(by.store.get(id, false)->state, api::JobState::queued);
}

TEST_F(PostgresOnly, ALossThatNoOutageExplainsIsCounted) {
  const std::string id = insert_id(stores->one());
  // The server has been up for long, as far as the lease is concerned.
  std::this_thread::sleep_for(ByItsClock::lease);
  ByItsClock by(stores->url);
  const auto start = std::chrono::steady_clock::now() - std::chrono::milliseconds(50);
  ASSERT_TRUE(by.claim());
  EXPECT_GE(by.lost(id, start), by.lease) << "the process begins by waiting for a whole lease, too";
  EXPECT_EQ(run("SELECT losses FROM jobs"), "1");
}

TEST_F(PostgresOnly, AttemptsBeginByTheClockOfTheDatabase) {
  ByItsClock by(stores->url);
  insert_id(by.store);
  const auto clock = [&] { return std::stoll(run("SELECT floor(extract(epoch FROM clock_timestamp()) * 1000)")); };
  const std::int64_t before = clock(), wrong = before + 3'600'000;
  const auto job = by.store.claim({"ahead", wrong, wrong + 60'000});
  ASSERT_TRUE(job && job->started_at);
  EXPECT_GE(*job->started_at, before);
  EXPECT_LE(*job->started_at, clock());
}

TEST_F(PostgresOnly, RevisionsLeapOnceWhereACrashMayHaveUndoneHeartbeats) {
  PostgresStore store({.url = stores->url, .patience = PostgresServer::patient()});
  insert_many(store, 2);
  const std::int64_t now = now_ms();
  const Attempt attempt{claim(store, now, "w", 60'000)->id, 1}, other{claim(store, now, "w", 60'000)->id, 1};
  const auto beat = [&](double fraction, std::uint64_t revision) {
    const auto held = store.heartbeat({"w", now, now + 60'000}, {{attempt, fraction, "grid", "", revision}});
    return held.size() == 1 ? held[0].revision : 0;
  };
  EXPECT_EQ(beat(0.5, 9), 9U);
  // As if the server had started since.
  run("UPDATE runs SET lease_until = pg_postmaster_start_time() + interval '59 s' WHERE id = '" + attempt.id + "'");
  const auto revision = [&](const Attempt& of) {
    run("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'bahnwerk'");
    return store.get(of.id, false)->revision;
  };
  const std::uint64_t raised = 9 + lost_leap;
  EXPECT_EQ(revision(attempt), raised);
  EXPECT_EQ(revision(attempt), raised) << "by the first one alone that connects";
  EXPECT_EQ(revision(other), 2U) << "of which was heard since the start";
  EXPECT_EQ(beat(0.75, 12), raised) << "so the worker goes on above it";
  EXPECT_EQ(store.get(attempt.id, false)->fraction, 0.5);
  EXPECT_EQ(beat(0.75, raised + 1), raised + 1);
  EXPECT_EQ(store.get(attempt.id, false)->fraction, 0.75);
  EXPECT_EQ(revision(attempt), raised + 1) << "nothing can have been undone";
}

TEST_F(PostgresOnly, AServerThatCanOnlyBeReadStandsInForOneThatCanBeWritten) {
  const std::string ended = insert_id(stores->one());
  stores->one().cancel(ended, 100);
  const std::string waiting = insert_id(stores->one());
  const std::size_t host = stores->url.find("host=") + 5;
  std::string url = stores->url + "&target_session_attrs=read-write";
  url.insert(host, "/nowhere,");
  const auto set = [&](const std::string& what) {
    run("BEGIN READ WRITE; ALTER DATABASE " + stores->url.substr(stores->url.rfind('=') + 1) + " " + what + "; COMMIT");
  };
  set("SET default_transaction_read_only = on");
  PostgresStore store({.url = url, .patience = PostgresServer::patient()});
  EXPECT_EQ(store.state(), StoreState::read_only);
  EXPECT_EQ(store.get(ended, false)->state, api::JobState::cancelled);
  EXPECT_THROW(store.get(waiting, false), StoreReadOnly) << "another server may have told more of it";
  EXPECT_THROW(store.get("01890000-0000-7000-8000-000000000000", false), StoreReadOnly) << "it may be newer";
  EXPECT_THROW(store.running(), StoreReadOnly);
  EXPECT_THROW(store.claim({"w", 1, 2}), StoreReadOnly);
  set("RESET default_transaction_read_only");
  while (store.state() != StoreState::up) try {
      store.get(waiting, false);
    } catch (const StoreReadOnly&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  EXPECT_EQ(store.get(waiting, false)->state, api::JobState::queued);
  EXPECT_TRUE(store.claim({"w", 1, 2}));
}

TEST_F(PostgresOnly, APooledSessionKeepsNothingAndPreparesNothing) {
  PostgresConnection connection(stores->url, PostgresServer::patient(), PostgresSession::pooled);
  const auto shown = [&](const char* setting) {
    return connection.run("SELECT current_setting($1)", PostgresParameters() << setting).text(0, 0);
  };
  EXPECT_EQ(shown("search_path"), "bahnwerk") << "within a transaction";
  EXPECT_EQ(connection.run_all({{"SELECT 1"}, {"SELECT 2"}}).at(1).integer(0, 0), 2);
  connection.begin();
  EXPECT_EQ(shown("lock_timeout"), "2s");
  EXPECT_EQ(connection.run("SELECT id FROM jobs").size(), 0U);
  connection.commit();
  EXPECT_THROW(connection.run("SELECT 1 / 0"), StoreError);
  EXPECT_TRUE(connection.idle());
  connection.script("CREATE TEMPORARY TABLE left_over AS SELECT current_setting('search_path') AS path");
  EXPECT_NE(connection.run("SELECT path FROM pg_temp.left_over").text(0, 0), "bahnwerk") << "outside of it";
  EXPECT_EQ(connection.run("SELECT count(*) FROM pg_prepared_statements").integer(0, 0), 0);
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
