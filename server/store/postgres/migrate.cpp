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

constexpr std::chrono::seconds patience{60};       ///< with others that are in the way of a step
constexpr std::chrono::milliseconds interval{50};  ///< between attempts
constexpr std::chrono::hours longest_index{48};

bool exists(PostgresConnection& connection) {
  return !connection
              .run(
                  "SELECT to_regclass('bahnwerk.schema_version') IS NOT NULL WHERE "
                  "to_regclass('bahnwerk.schema_version') IS NOT NULL")
              .empty();
}

/// Returns the name of the index that the step makes beside writers; empty: it is a transaction.
std::string_view index_of(const Migration& step) {
  if (std::string_view(step.sql).find("CREATE INDEX CONCURRENTLY ") == std::string_view::npos) return "";
  return step.name.substr(step.name.find('_') + 1);
}

/// Makes an index while others write. One that was cut off leaves an index that is not valid. Nobody waits for this
/// statement, so it may wait for the transactions that are open, however long.
void make_index(PostgresConnection& connection, const Migration& step) {
  const std::string name(index_of(step));
  const auto found = connection.run("SELECT indisvalid FROM pg_index WHERE indexrelid = to_regclass($1)",
                                    PostgresParameters() << "bahnwerk." + name);
  if (!found.empty() && found.flag(0, 0)) return;
  connection.without_timeouts();
  if (!found.empty()) connection.script("DROP INDEX CONCURRENTLY bahnwerk." + name);
  connection.script(step.sql);
}

/// Applies the step in a transaction that has the lock, unless another process has. The lock is tried, and not waited
/// for: whoever waits within the call has a snapshot, for which an index that is made beside writers waits.
/// Returns false where another process has the lock.
bool apply(PostgresConnection& connection, const Migration& step) {
  connection.begin();
  if (!try_lock(connection, PostgresLock::migration)) {
    connection.rollback();
    return false;
  }
  if (!exists(connection))
    connection.script(
        "CREATE SCHEMA IF NOT EXISTS bahnwerk; "
        "CREATE TABLE bahnwerk.schema_version (version bigint PRIMARY KEY, min_reader bigint NOT NULL)");
  if (postgres_version(connection) < step.number) {
    if (index_of(step).empty()) {
      connection.script(step.sql);
    } else {
      // The lock is held by a transaction without a snapshot: a script ends that of the statement before.
      connection.script("SET LOCAL idle_in_transaction_session_timeout = 0");
      make_index(*connection.another({.lengthy = longest_index}), step);
    }
    connection.run("INSERT INTO bahnwerk.schema_version VALUES ($1, $2)",
                   PostgresParameters() << std::int64_t{step.number} << min_reader);
  }
  connection.commit();
  return true;
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

void migrate(PostgresConnection& connection, std::span<const Migration> migrations) {
  const int version = postgres_version(connection);
  for (const Migration& step : migrations) {
    if (step.number <= version) continue;
    const auto until = std::chrono::steady_clock::now() + patience;
    for (;; std::this_thread::sleep_for(interval)) {
      const bool last = std::chrono::steady_clock::now() >= until;
      try {
        if (apply(connection, step)) break;
        if (last) throw StoreError("another process is changing the store's schema; try again", false, true);
      } catch (const StoreAway&) {
        connection.rollback();
        throw;
      } catch (const StoreError& error) {
        connection.rollback();
        if (!error.busy || last) throw;
      }
    }
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
