/// The schema of the PostgreSQL store: its steps, beside others that use the store, and what it needs of its server.
#include <thread>

#include "../postgres_wire.hpp"
#include "server/runtime/clock.hpp"
#include "server/store/postgres/migrate.hpp"
#include "stores.hpp"

namespace bahnwerk::server {
namespace {

struct PostgresSchema : testing::Test {
  void SetUp() override {
    if (PostgresStores::missing()) GTEST_SKIP() << "its server is not installed";
    stores.emplace();
  }
  std::string run(const std::string& sql) const {
    return PostgresServer::run(stores->url, "SET search_path = bahnwerk; " + sql);
  }
  void until(const std::string& sql) const {
    while (run("SELECT (" + sql + ")::text") != "true") std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  /// Returns the migrations with one more.
  static std::vector<Migration> with(const char* name, const char* sql) {
    const auto known = postgres_migrations();
    std::vector<Migration> steps(known.begin(), known.end());
    steps.push_back({static_cast<int>(steps.size()) + 1, name, sql});
    return steps;
  }
  void apply(const std::vector<Migration>& steps, PostgresSession session = PostgresSession::own) const {
    PostgresConnection connection(stores->url, PostgresServer::patient(), session);
    migrate(connection, steps);
  }
  std::string version() const { return run("SELECT max(version) FROM schema_version"); }
  std::optional<PostgresStores> stores;
};

TEST_F(PostgresSchema, AStoreThatNeedsANewerProgramIsRefused) {
  run("INSERT INTO schema_version VALUES (1000, 1)");
  EXPECT_NO_THROW(stores->restart()) << "it is newer, and this program may use it";
  run("UPDATE schema_version SET min_reader = 1000 WHERE version = 1000");
  EXPECT_THROW(PostgresStore({.url = stores->url}), StoreError);
}

TEST_F(PostgresSchema, AnOlderSchemaIsRefusedWhereItMayNotBeChanged) {
  const PostgresOptions options{.url = stores->url, .patience = PostgresServer::patient(), .migrate = false};
  EXPECT_NO_THROW(const PostgresStore store(options));
  run("UPDATE schema_version SET version = version - 1");
  EXPECT_THROW(const PostgresStore store(options), StoreError);
}

TEST_F(PostgresSchema, EachDayHasItsPartition) {
  EXPECT_EQ(run("SELECT count(*) >= 4 FROM pg_inherits WHERE inhparent = 'chunks'::regclass"), "t");
  NewJob job = new_job();
  job.now = now_ms();
  const std::string id = insert_id(stores->one(), job);
  EXPECT_NE(run("SELECT tableoid::regclass FROM specs WHERE id = '" + id + "'"), "specs_rest");
  EXPECT_TRUE(claim(stores->other(), 1));
}

constexpr auto* make_extra = "-- An index.\nCREATE INDEX CONCURRENTLY jobs_extra ON bahnwerk.jobs (name, kind);";
constexpr auto* extra_is_valid = "SELECT indisvalid FROM pg_index WHERE indexrelid = 'jobs_extra'::regclass";
constexpr auto* extra_is_waiting =
    "SELECT count(*) > 0 FROM pg_stat_activity WHERE query LIKE '%CONCURRENTLY jobs_extra ON%' AND wait_event_type = "
    "'Lock' AND datname = current_database() AND pid <> pg_backend_pid()";

TEST_F(PostgresSchema, AnIndexIsMadeBesideThoseWhoWriteByOneOfThoseWhoTry) {
  const auto steps = with("0099_jobs_extra", make_extra);
  const std::string before = version();
  insert_id(stores->one());
  PostgresConnection writer(stores->url, PostgresServer::patient());
  writer.begin();
  writer.run("UPDATE jobs SET name = 'x'");
  std::thread first([&] { apply(steps); });
  until(extra_is_waiting);
  EXPECT_EQ(version(), before) << "it waits for the writer";
  EXPECT_FALSE(insert_id(stores->other()).empty()) << "and nobody waits for it";
  PostgresConnection second(stores->url, PostgresServer::patient());
  second.begin();
  EXPECT_FALSE(
      second.run("SELECT pg_try_advisory_xact_lock($1)", PostgresParameters() << std::int64_t{0x6261686e77657201})
          .flag(0, 0))
      << "it has the lock of all steps";
  second.rollback();
  writer.commit();
  first.join();
  EXPECT_EQ(run(extra_is_valid), "t");
  EXPECT_EQ(version(), std::to_string(steps.size()));
  apply(steps);
  EXPECT_EQ(run("SELECT count(*) FROM schema_version"), std::to_string(steps.size()));
}

TEST_F(PostgresSchema, AnIndexThatWasCutOffIsMadeAgain) {
  for (const PostgresSession session : {PostgresSession::own, PostgresSession::pooled}) {
    const auto steps = with("0099_jobs_extra", make_extra);
    insert_id(stores->one());
    PostgresConnection writer(stores->url, PostgresServer::patient());
    writer.begin();
    writer.run("UPDATE jobs SET name = 'x'");
    std::thread cut([&] { EXPECT_THROW(apply(steps, session), StoreAway); });
    until(extra_is_waiting);
    run("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE query LIKE '%CONCURRENTLY jobs_extra ON%' AND "
        "pid "
        "<> pg_backend_pid()");
    cut.join();
    EXPECT_EQ(run(extra_is_valid), "f");
    EXPECT_NE(version(), std::to_string(steps.size()));
    writer.rollback();
    apply(steps, session);
    EXPECT_EQ(run(extra_is_valid), "t");
    EXPECT_EQ(version(), std::to_string(steps.size()));
    run("DROP INDEX jobs_extra; DELETE FROM schema_version WHERE version = " + std::to_string(steps.size()));
  }
}

TEST_F(PostgresSchema, AnIndexThatIsThereIsNotMadeAgain) {
  run("CREATE INDEX jobs_extra ON jobs (name)");
  const std::string made = run("SELECT 'jobs_extra'::regclass::oid");
  apply(with("0099_jobs_extra", make_extra));
  EXPECT_EQ(run("SELECT 'jobs_extra'::regclass::oid"), made) << "its process ended before it could say so";
}

TEST_F(PostgresSchema, AStepIsTriedAgainWhereOthersAreInItsWay) {
  const auto steps = with("0099_more", "ALTER TABLE jobs ADD COLUMN more int");
  PostgresConnection writer(stores->url, PostgresServer::patient());
  writer.begin();
  writer.script("LOCK TABLE jobs IN SHARE MODE; SET LOCAL idle_in_transaction_session_timeout = 0");
  std::thread step([&] { apply(steps); });
  const std::string waits = "SELECT count(*) > 0 FROM pg_locks WHERE relation = 'jobs'::regclass AND NOT granted";
  until(waits);
  until("SELECT NOT (" + waits + ")");
  EXPECT_NE(version(), std::to_string(steps.size())) << "it gave up, so that others do not wait behind it for long";
  writer.rollback();
  step.join();
  EXPECT_EQ(version(), std::to_string(steps.size()));
}

TEST_F(PostgresSchema, StepsBeforeOneThatFailsStay) {
  auto steps = with("0098_more", "ALTER TABLE jobs ADD COLUMN more int");
  steps.push_back({static_cast<int>(steps.size()) + 1, "0099_wrong",
                   "ALTER TABLE jobs ADD COLUMN last int; ALTER TABLE none ADD COLUMN x int"});
  EXPECT_THROW(apply(steps), StoreError);
  EXPECT_EQ(version(), std::to_string(steps.size() - 1));
  EXPECT_EQ(run("SELECT count(*) FROM information_schema.columns WHERE table_name = 'jobs' AND column_name IN ('more', "
                "'last')"),
            "1");
}

TEST_F(PostgresSchema, WhatTheServerLacksIsNamedAndRefused) {
  run("CREATE ROLE poor LOGIN; GRANT USAGE ON SCHEMA bahnwerk TO poor; GRANT ALL ON ALL TABLES IN SCHEMA bahnwerk TO "
      "poor");
  std::string url = stores->url;
  url.replace(url.find("postgres@"), 9, "poor@");
  const auto why = [&] {
    try {
      const PostgresStore store({.url = url, .patience = PostgresServer::patient(), .migrate = false});
    } catch (const StoreRefused& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(why(), "");
  run("REVOKE EXECUTE ON FUNCTION pg_current_snapshot() FROM PUBLIC; REVOKE UPDATE ON jobs FROM poor");
  EXPECT_NE(why().find("pg_current_snapshot"), std::string::npos) << why();
  EXPECT_EQ(why().find("advisory"), std::string::npos) << why();
  run("REVOKE EXECUTE ON FUNCTION pg_try_advisory_xact_lock_shared(bigint) FROM PUBLIC");
  EXPECT_NE(why().find("advisory locks"), std::string::npos) << why();
}

/// Servers of another kind, which a proxy makes of this one: it changes what they are asked, or what they say.
struct PostgresKin : PostgresSchema {
  /// Returns why a store is refused; empty: it is not.
  std::string refusal(const std::vector<std::pair<std::string, std::string>>& replaced) const {
    PostgresWire wire(stores->url);
    for (const auto& [from, to] : replaced) wire.replace(from, to);
    try {
      const PostgresStore store({.url = wire.url(), .patience = PostgresServer::patient()});
    } catch (const StoreRefused& error) {
      return error.what();
    }
    return "";
  }
  static bool names(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }
};

TEST_F(PostgresKin, WithoutWhatTheStoreNeedsAreRefusedByName) {
  const std::string snapshots = "pg_current_snapshot", locks = "advisory locks", skips = "SKIP LOCKED";
  EXPECT_EQ(refusal({}), "");
  const std::string unknown = refusal({{"SKIP LOCKED", "SKIP LOCKEX"}});
  EXPECT_TRUE(names(unknown, skips)) << unknown;
  const std::string both = refusal({{"pg_current_snapshot()", "pg_currend_snapshot()"},
                                    {"pg_try_advisory_xact_lock_shared", "pg_try_advisory_xact_lock_sharex"}});
  EXPECT_TRUE(names(both, snapshots) && names(both, locks) && !names(both, skips)) << both;
  const std::string asked = "SELECT pg_try_advisory_xact_lock_shared($1)";
  std::string answered = "SELECT $1 IS NOT NULL";
  answered.resize(asked.size(), ' ');
  const std::string nothing = refusal({{asked, answered}});
  EXPECT_TRUE(names(nothing, locks) && names(nothing, "does nothing")) << nothing;
}

TEST_F(PostgresKin, OlderThanVersion15AreRefusedByTheirVersion) {
  const std::string own = run("SHOW server_version_num").substr(0, 2);
  const std::string key("server_version\0", 15);
  for (const char* const version : {"14", "13"}) {
    const std::string why = refusal({{key + own, key + version}});
    EXPECT_TRUE(names(why, "has version " + std::string(version)) && names(why, "15.0 or later")) << why;
  }
}

TEST_F(PostgresKin, ThatCanOnlyBeReadServeWhatHasEnded) {
  const std::string id = insert_id(stores->one()), queued = insert_id(stores->one());
  stores->one().cancel(id, now_ms());
  const std::string database = run("SELECT current_database()");
  run("ALTER DATABASE " + database + " SET default_transaction_read_only = on");
  PostgresStore store({.url = stores->url, .patience = PostgresServer::patient()});
  EXPECT_EQ(store.state(), StoreState::read_only);
  EXPECT_TRUE(store.get(id, false));
  EXPECT_THROW(store.get(queued, false), StoreReadOnly);
  EXPECT_THROW(insert(store, new_job()), StoreReadOnly);
  EXPECT_THROW(store.claim({"w", now_ms(), now_ms() + 1000}), StoreReadOnly);
}

TEST_F(PostgresKin, ThatCanOnlyBeReadStandInWhereTheUrlAsksForOneToWrite) {
  run("ALTER DATABASE " + run("SELECT current_database()") + " SET default_transaction_read_only = on");
  const PostgresConnection connection(stores->url + "&target_session_attrs=read-write", PostgresServer::patient());
  EXPECT_TRUE(connection.stopgap());
}

}  // namespace
}  // namespace bahnwerk::server
