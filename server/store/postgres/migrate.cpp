#include "server/store/postgres/migrate.hpp"

#include <chrono>
#include <string>
#include <thread>

#include "server/store/postgres/commands.hpp"
#include "server/store/postgres/connection.hpp"
#include "server/store/postgres/locks.hpp"
#include "server/store/postgres/partitions.hpp"

namespace bahnwerk::server {
namespace {

/// The least version of the program's schema that may use a store with the migrations of this program.
constexpr std::int64_t min_reader = 1;

constexpr std::chrono::seconds lock_patience{60};
constexpr std::chrono::milliseconds lock_interval{50};

bool exists(PostgresConnection& connection) {
  return !connection
              .run(
                  "SELECT to_regclass('bahnwerk.schema_version') IS NOT NULL WHERE "
                  "to_regclass('bahnwerk.schema_version') IS NOT NULL")
              .empty();
}

/// Begins a transaction that has the lock. Whoever waited for it inside of the call would hold a snapshot meanwhile.
void begin_locked(PostgresConnection& connection) {
  const auto until = std::chrono::steady_clock::now() + lock_patience;
  for (;;) {
    connection.begin();
    if (try_lock(connection, PostgresLock::migration)) return;
    connection.rollback();
    if (std::chrono::steady_clock::now() >= until)
      throw StoreError("another process is changing the store's schema; try again", false, true);
    std::this_thread::sleep_for(lock_interval);
  }
}

}  // namespace

int postgres_version(PostgresConnection& connection) {
  if (!exists(connection)) return 0;
  const auto rows =
      connection.run("SELECT coalesce(max(version), 0), coalesce(max(min_reader), 0) FROM bahnwerk.schema_version");
  const auto least = rows.integer(0, 1), known = static_cast<std::int64_t>(postgres_migrations().size());
  if (least > known)
    throw StoreRefused("the store was written by a newer version: it needs schema version " + std::to_string(least) +
                       ", this program knows only up to " + std::to_string(known));
  return static_cast<int>(rows.integer(0, 0));
}

void migrate(PostgresConnection& connection) {
  const auto known = static_cast<int>(postgres_migrations().size());
  if (postgres_version(connection) >= known) return;
  begin_locked(connection);
  try {
    if (!exists(connection))
      connection.script(
          "CREATE SCHEMA IF NOT EXISTS bahnwerk; "
          "CREATE TABLE bahnwerk.schema_version (version bigint PRIMARY KEY, min_reader bigint NOT NULL)");
    const int version = postgres_version(connection);
    for (const Migration& migration : postgres_migrations()) {
      if (migration.number <= version) continue;
      connection.script(migration.sql);
      connection.run("INSERT INTO bahnwerk.schema_version VALUES ($1, $2)",
                     PostgresParameters() << std::int64_t{migration.number} << min_reader);
    }
    connection.commit();
  } catch (...) {
    connection.rollback();
    throw;
  }
}

void require_up_to_date(PostgresConnection& connection) {
  const int version = postgres_version(connection), known = static_cast<int>(postgres_migrations().size());
  if (version < known) throw StoreRefused(not_migrated(version, known));
}

namespace postgres {

int bring_up_to_date(const std::string& url) {
  PostgresConnection connection(url);
  migrate(connection);
  keep_partitions(connection);
  return postgres_version(connection);
}

}  // namespace postgres
}  // namespace bahnwerk::server
