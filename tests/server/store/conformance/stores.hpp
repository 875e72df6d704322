#pragma once
/// What every store must hold. A store comes with a trait that makes it: add yours to Stores.
#include "../fixture.hpp"
#include "../postgres_server.hpp"

namespace bahnwerk::server {

/// One database, empty at first. `one` and `other` are two processes' views of it, the same object where a second
/// process may not have it.
struct SqliteStores {
  static constexpr const char* name = "Sqlite";
  static constexpr bool restart_ends_leases = true;  ///< else they run out in their time
  static bool missing() { return false; }
  SqliteStores() { restart(); }
  void restart(int engine = api::engine_level) {
    store.reset();
    store = std::make_unique<SqliteStore>(
        SqliteOptions{.path = (folder.path / "store.db").string(), .planned_by = "7.1", .engine = engine});
  }
  Store& one() { return *store; }
  Store& other() { return *store; }

  TempFolder folder;
  std::unique_ptr<Store> store;
};

template <PostgresSession session>
struct PostgresStoresBy {
  static constexpr const char* name = session == PostgresSession::pooled ? "PostgresPooled" : "Postgres";
  static constexpr bool restart_ends_leases = false;
  static bool missing() { return PostgresServer::missing(); }
  PostgresStoresBy() { restart(); }
  ~PostgresStoresBy() {
    first.reset();
    second.reset();
    PostgresServer::one().drop_database(url);
  }
  void restart(int engine = api::engine_level) {
    first.reset();
    second.reset();
    const PostgresOptions options{.url = url,
                                  .patience = PostgresServer::patient(),
                                  .session = session,
                                  .planned_by = "7.1",
                                  .engine = engine,
                                  .times_of_callers = true};
    first = std::make_unique<PostgresStore>(options);
    second = std::make_unique<PostgresStore>(options);
  }
  Store& one() { return *first; }
  Store& other() { return *second; }

  const std::string url = PostgresServer::one().make_database();
  std::unique_ptr<Store> first, second;
};

using PostgresStores = PostgresStoresBy<PostgresSession::own>;
/// Each transaction sets what it needs, as behind a pooler that gives it another session.
using PooledStores = PostgresStoresBy<PostgresSession::pooled>;

using Stores = testing::Types<SqliteStores, PostgresStores, PooledStores>;
struct StoreNames {
  template <class S>
  static std::string GetName(int) {
    return S::name;
  }
};

template <class S>
struct Conformance : testing::Test {
  void SetUp() override {
    if (S::missing()) GTEST_SKIP() << "its server is not installed";
    stores.emplace();
    here = &stores->one();
    other = &stores->other();
  }
  /// Opens the stores again, as a program with planners of that level.
  void restart(int engine = api::engine_level) {
    stores->restart(engine);
    here = &stores->one();
    other = &stores->other();
  }
  void queue(int count) {
    for (int i = 0; i < count; ++i) insert_id(*here);
  }
  std::optional<S> stores;
  Store* here = nullptr;
  Store* other = nullptr;
  Progress silent;
};

}  // namespace bahnwerk::server
