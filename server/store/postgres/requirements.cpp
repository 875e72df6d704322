#include "server/store/postgres/requirements.hpp"

#include <span>
#include <string>

#include "server/store/postgres/locks.hpp"

namespace bahnwerk::server {
namespace {

/// What is asked for, by a call that fails, or returns false, where the server has it not.
struct Requirement {
  const char* name;
  bool (*there)(PostgresConnection&);
};

bool has_snapshots(PostgresConnection& connection) {
  return connection
      .run(
          "SELECT pg_visible_in_snapshot(pg_snapshot_xmin(pg_current_snapshot()), pg_current_snapshot()) IS NOT NULL "
          "AND coalesce(pg_current_xact_id_if_assigned() >= '0'::xid8, true)")
      .flag(0, 0);
}

/// A server may accept the call without taking a lock. The lock is a shared one, so that processes that start at once
/// are not in each other's way.
bool has_locks(PostgresConnection& connection) {
  return connection
      .run_all({{"SELECT pg_try_advisory_xact_lock_shared($1)", PostgresParameters()
                                                                    << static_cast<std::int64_t>(PostgresLock::none)},
                {"SELECT EXISTS (SELECT FROM pg_locks WHERE locktype = 'advisory' AND pid = pg_backend_pid())"}})
      .at(1)
      .flag(0, 0);
}

bool has_skip_locked(PostgresConnection& connection) {
  connection.run("SELECT id FROM jobs WHERE false LIMIT 1 FOR UPDATE SKIP LOCKED");
  return true;
}

void require(PostgresConnection& connection, std::span<const Requirement> requirements) {
  std::string missing;
  for (const Requirement& requirement : requirements) {
    std::string why = ": it takes the call and does nothing";
    try {
      if (requirement.there(connection)) continue;
    } catch (const StoreReadOnly&) {  // a standby has what its primary has
      continue;
    } catch (const StoreError& error) {
      if (error.busy || error.full) throw;
      why = std::string(" (") + error.what() + ")";
    }
    missing.append(missing.empty() ? "" : "; ").append(requirement.name).append(why);
  }
  if (!missing.empty()) throw StoreRefused("the server lacks what a PostgreSQL store needs: " + missing);
}

}  // namespace

void require_capabilities(PostgresConnection& connection) {
  static constexpr Requirement requirements[] = {
      {"snapshots of transactions, pg_current_snapshot and xid8", has_snapshots},
      {"advisory locks of transactions", has_locks}};
  require(connection, requirements);
}

void require_queue(PostgresConnection& connection) {
  static constexpr Requirement requirements[] = {{"FOR UPDATE SKIP LOCKED", has_skip_locked}};
  require(connection, requirements);
}

}  // namespace bahnwerk::server
