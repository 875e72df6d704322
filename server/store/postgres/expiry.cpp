/// PostgresStore: what ends by the clock, by deadlines in the queue, leases of attempts and the retention. Any process
/// does it, for all; rows that another one has in hand are left to it.
#include <algorithm>

#include "server/store/postgres/locks.hpp"
#include "server/store/postgres/partitions.hpp"
#include "server/store/postgres/postgres_store.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t removed_at_once = 64, swept_at_once = 64;
constexpr std::chrono::seconds between_maintenance{10};
constexpr std::int64_t look_again = 1'000;  ///< ms until a lease is looked at again that may not be ended yet
constexpr std::int64_t folded_from = 200;   ///< rows of counts

std::optional<std::int64_t> earlier(std::optional<std::int64_t> a, std::optional<std::int64_t> b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

}  // namespace

/// Fence: the job is queued, and its row is locked. READ COMMITTED.
std::vector<std::string> PostgresStore::end_late(std::int64_t now) {
  std::vector<std::string> ids;
  writing([&](PostgresConnection& connection) {
    ids.clear();
    connection.begin();
    const auto late = connection.run(
        "SELECT id FROM jobs WHERE state = 'queued' AND deadline <= coalesce($1, clock_timestamp()) ORDER BY deadline "
        "LIMIT $2 FOR UPDATE SKIP LOCKED",
        PostgresParameters().time(clock(now)) << static_cast<std::int64_t>(at_once));
    Statements statements;
    for (std::size_t row = 0; row < late.size(); ++row) {
      ids.push_back(late.uuid(row, 0));
      statements.push_back(statement_of(
          {.id = ids.back(), .from = api::JobState::queued, .to = after_deadline(ids.back()), .now = now}));
    }
    connection.run_all_lengthy(statements);
    connection.commit_briefly();
  });
  std::vector<Changed> changes;
  for (const std::string& id : ids) changes.push_back({.id = id, .state = api::JobState::failed});
  publish(changes);
  return ids;
}

/// Fence: rows of the job and of the attempt are locked, and the lease is looked at under the lock. A lease counts as
/// run out only where this process and the server have been up for its whole length: after an outage every living
/// worker renews its leases first. One that ran out sooner than its length after an outage was not renewed since, for
/// which the outage may be the reason: its loss is not counted. READ COMMITTED.
std::vector<std::string> PostgresStore::lose(std::int64_t now) {
  std::vector<std::string> ids;
  std::vector<Changed> changes;
  const auto unbroken =
      options_.times_of_callers ? std::nullopt : std::optional<std::int64_t>(state_.unbroken().count());
  const auto outage = options_.times_of_callers ? std::nullopt : state_.since_outage();
  const auto since_outage = outage ? std::optional<std::int64_t>(outage->count()) : std::nullopt;
  writing([&](PostgresConnection& connection) {
    ids.clear();
    changes.clear();
    connection.begin();
    const auto lost = connection.run(
        "SELECT r.id, r.token, j.cancel_requested, j.losses + CASE WHEN (SELECT count(*) FROM runs AS other WHERE "
        "other.worker = r.worker) = 1 AND ($2 IS NULL OR r.lease_until - r.lease_ms * interval '1 ms' > greatest("
        "pg_postmaster_start_time(), clock_timestamp() - $4 * interval '1 ms')) THEN 1 ELSE 0 END "
        "FROM runs AS r JOIN jobs AS j ON j.id = r.id "
        "WHERE r.lease_until <= coalesce($1, clock_timestamp()) AND ($2 IS NULL OR (r.lease_ms <= $2 AND "
        "clock_timestamp() - pg_postmaster_start_time() >= r.lease_ms * interval '1 ms')) "
        "LIMIT $3 FOR UPDATE OF j, r SKIP LOCKED",
        PostgresParameters().time(clock(now)) << unbroken << static_cast<std::int64_t>(at_once) << since_outage);
    Statements statements;
    for (std::size_t row = 0; row < lost.size(); ++row) {
      const std::string id = lost.uuid(row, 0);
      const std::int64_t losses = lost.integer(row, 3);
      const Fate fate = after_loss(id, losses, lost.flag(row, 2));
      statements.push_back(statement_of({.id = id,
                                         .from = api::JobState::running,
                                         .token = lost.integer(row, 1),
                                         .to = fate,
                                         .now = now,
                                         .leap = lost_leap,
                                         .losses = losses}));
      ids.push_back(id);
      changes.push_back({.id = id, .state = fate.state});
    }
    connection.run_all_lengthy(statements);
    connection.commit_briefly();
  });
  publish(changes);
  return ids;
}

std::vector<std::string> PostgresStore::too_old(PostgresConnection& connection, std::int64_t now,
                                                std::size_t most) const {
  const Retention& keep = options_.retention;
  if (!keep.time && !keep.jobs && !keep.bytes) return {};
  std::int64_t more = 0;  // ended jobs beyond the limits of number and bytes, as far as is known
  if (keep.jobs)
    more = connection
               .run("SELECT coalesce(sum(jobs), 0)::bigint FROM count_deltas WHERE state NOT IN ('queued', 'running')")
               .integer(0, 0) -
           *keep.jobs;
  if (keep.bytes && connection.run_lengthy("SELECT pg_database_size(current_database())").integer(0, 0) > *keep.bytes)
    more = std::max<std::int64_t>(more, 1);  // one: the next look measures again
  const auto rows = connection.run(
      "SELECT id, finished_at FROM jobs WHERE finished_at IS NOT NULL AND callback_due IS NULL ORDER BY finished_at "
      "LIMIT $1",
      PostgresParameters() << static_cast<std::int64_t>(most));
  std::vector<std::string> ids;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const bool late = keep.time && rows.time(row, 1) <= now - *keep.time;
    if (!late && static_cast<std::int64_t>(ids.size()) >= more) break;
    ids.push_back(rows.uuid(row, 0));
  }
  return ids;
}

Expired PostgresStore::expire(std::int64_t now) {
  struct Look {
    std::optional<std::int64_t> deadline, lease;
    bool leftovers = false;
    std::int64_t now = 0;
  };
  const auto look = [&] {
    return reading([&](PostgresConnection& connection) {
      const auto row = connection.run(
          "SELECT (SELECT min(deadline) FROM jobs WHERE state = 'queued' AND deadline IS NOT NULL), "
          "(SELECT min(lease_until) FROM runs WHERE lease_until < 'infinity'), EXISTS (SELECT FROM leftovers), "
          "coalesce($1, clock_timestamp())",
          PostgresParameters().time(clock(now)));
      return Look{row.optional_time(0, 0), row.optional_time(0, 1), row.flag(0, 2), row.time(0, 3)};
    });
  };
  Expired expired;
  Look found = look();
  if (found.deadline && *found.deadline <= found.now) expired.ids = end_late(now);
  if (found.lease && *found.lease <= found.now) expired.lost = lose(now);
  if (found.leftovers || !expired.lost.empty()) {
    const auto rows = reading([](PostgresConnection& connection) {
      return connection.run("SELECT id, token FROM leftovers LIMIT $1",
                            PostgresParameters() << static_cast<std::int64_t>(swept_at_once));
    });
    for (std::size_t row = 0; row < rows.size(); ++row)
      if (sweep(rows.uuid(row, 0), rows.integer(row, 1))) break;  // more of it the next time
  }
  const auto old = reading([&](PostgresConnection& connection) { return too_old(connection, now, removed_at_once); });
  for (const std::string& id : old) expired.removed += remove(id, {}) == Removed::yes ? 1 : 0;
  maintain();
  found = look();
  // A lease that has run out and was not ended is in another's hand, or not to be ended yet.
  if (found.lease && expired.lost.size() < at_once && *found.lease <= found.now) found.lease = found.now + look_again;
  expired.next = earlier(found.deadline, found.lease);
  if (found.leftovers || expired.removed > 0) expired.next = found.now;
  // The caller's clock may be another one than the database's.
  if (expired.next) *expired.next += std::clamp<std::int64_t>(now - found.now, -ms_per_day, ms_per_day);
  return expired;
}

/// Frees about 2 MB of what a job or an attempt has left; returns whether there may be more.
bool PostgresStore::sweep(const std::string& id, std::int64_t token) {
  return with_connection(true, [&](PostgresConnection& connection) {
    PostgresParameters key;
    key.uuid(id) << token;
    const auto rows = connection.run_all_lengthy(
        {{"DELETE FROM chunks WHERE id = $1 AND (id, token, first_row) IN (SELECT id, token, first_row FROM chunks "
          "WHERE id = $1 AND ($2 = 0 OR token = $2) LIMIT 16)",
          key},
         {"DELETE FROM views WHERE id = $1 AND (id, token, name, part) IN (SELECT id, token, name, part FROM views "
          "WHERE id = $1 AND ($2 = 0 OR token = $2) LIMIT 64)",
          key}});
    if (rows[0].changed() > 0 || rows[1].changed() > 0) return true;
    connection.run("DELETE FROM leftovers WHERE id = $1 AND token = $2", key);
    return false;
  });
}

/// Does, each time in one process alone, what keeps tables short.
void PostgresStore::maintain() {
  {
    const std::lock_guard lock(maintenance_mutex_);
    const auto time = std::chrono::steady_clock::now();
    if (maintained_ != decltype(maintained_){} && time < maintained_ + between_maintenance) return;
    maintained_ = time;
  }
  try {
    writing([&](PostgresConnection& connection) {
      connection.begin();
      if (!try_lock(connection, PostgresLock::maintenance)) return connection.rollback();
      if (connection.run("SELECT count(*) FROM count_deltas").integer(0, 0) >= folded_from)
        connection.run_lengthy(
            "WITH old AS (DELETE FROM count_deltas RETURNING state, owner, jobs) INSERT INTO count_deltas (state, "
            "owner, jobs) SELECT state, owner, sum(jobs) FROM old GROUP BY state, owner HAVING sum(jobs) <> 0");
      connection.run_lengthy(
          "DELETE FROM changes USING change_feed AS feed WHERE changes.at < now() - interval '10 minutes' AND "
          "changes.xid < pg_snapshot_xmin(feed.snapshot)");
      connection.commit();
    });
    if (options_.migrate) writing([&](PostgresConnection& connection) { keep_partitions(connection); });
  } catch (const StoreError&) {  // the next time will do
  }
}

}  // namespace bahnwerk::server
