/// PostgresStore: the sequence of changes. Transactions note what they change with their own id. A number given then
/// would become visible out of order; so changes get their numbers when they are asked for, by one transaction at a
/// time, in the order of the transactions' ids: those that are visible to it and were not to the one before, which
/// `pg_visible_in_snapshot` tells exactly, and nobody waits for a transaction that is still open. All processes see the
/// same numbers.
#include "server/store/postgres/postgres_store.hpp"

namespace bahnwerk::server {
namespace {

constexpr auto make_feed =
    "INSERT INTO change_feed (snapshot, last, lowest) SELECT pg_current_snapshot(), us, us FROM "
    "(SELECT (extract(epoch FROM clock_timestamp()) * 1000000)::bigint AS us) AS now ON CONFLICT DO NOTHING";

/// Isolation: READ COMMITTED, with the feed's row locked by the statement before: this one's snapshot is later than
/// that of whoever had the lock.
constexpr auto number_all =
    "WITH feed AS (SELECT snapshot, last FROM change_feed), "
    "fresh AS (SELECT DISTINCT ON (c.id) c.id, c.owner, c.xid FROM changes AS c, feed WHERE c.xid >= "
    "pg_snapshot_xmin(feed.snapshot) AND NOT pg_visible_in_snapshot(c.xid, feed.snapshot) ORDER BY c.id, c.xid DESC), "
    "numbered AS (SELECT fresh.id, fresh.owner, feed.last + row_number() OVER (ORDER BY fresh.xid, fresh.id) AS "
    "number, "
    "NOT EXISTS (SELECT FROM jobs WHERE jobs.id = fresh.id) AS gone FROM fresh, feed), "
    "stored AS (INSERT INTO change_numbers AS n (id, owner, number, gone) SELECT id, owner, number, gone FROM numbered "
    "ON CONFLICT (id) DO UPDATE SET number = excluded.number, gone = excluded.gone, at = excluded.at "
    "RETURNING n.number, n.gone) "
    "UPDATE change_feed SET snapshot = pg_current_snapshot(), last = coalesce((SELECT max(number) FROM stored), last) "
    "RETURNING last, EXISTS (SELECT FROM stored WHERE gone)";

/// Forgets removals beyond kept_removals.
constexpr auto forget_removals =
    "WITH cut AS (SELECT number FROM change_numbers WHERE gone ORDER BY number DESC OFFSET $1 LIMIT 1), "
    "forgotten AS (DELETE FROM change_numbers AS n USING cut WHERE n.gone AND n.number <= cut.number) "
    "UPDATE change_feed SET lowest = greatest(lowest, cut.number) FROM cut";

}  // namespace

/// The transaction is sent as a whole: a process that stands still in between has no lock for which others wait.
std::uint64_t PostgresStore::number_changes(PostgresConnection& connection) {
  const auto number = [&] {
    return connection.run_all_lengthy({{"SELECT 1 FROM change_feed FOR UPDATE"}, {number_all}}).at(1);
  };
  auto numbered = number();
  if (numbered.empty()) {  // there is no row: the store is new, or emptied by a crash
    connection.run(make_feed);
    numbered = number();
  }
  if (numbered.flag(0, 1)) connection.run_lengthy(forget_removals, PostgresParameters() << kept_removals);
  return static_cast<std::uint64_t>(numbered.integer(0, 0));
}

/// Returns the last number, after all changes that are visible now have theirs; while the disk is full they get them
/// later.
std::uint64_t PostgresStore::numbered(PostgresConnection& connection) {
  const auto feed = connection.run(
      "SELECT last, EXISTS (SELECT FROM changes AS c WHERE c.xid >= pg_snapshot_xmin(snapshot) AND NOT "
      "pg_visible_in_snapshot(c.xid, snapshot)) FROM change_feed");
  if (!feed.empty() && !feed.flag(0, 1)) return static_cast<std::uint64_t>(feed.integer(0, 0));
  try {
    return number_changes(connection);
  } catch (const StoreError& error) {
    if (!error.full || feed.empty()) throw;
    connection.rollback();
    return static_cast<std::uint64_t>(feed.integer(0, 0));
  }
}

std::uint64_t PostgresStore::last_change() {
  return reading([&](PostgresConnection& connection) { return numbered(connection); });
}

Changes PostgresStore::changes_since(std::uint64_t sequence, std::size_t limit,
                                     const std::optional<std::string>& owner) {
  return reading([&](PostgresConnection& connection) {
    const std::uint64_t last = numbered(connection);
    PostgresParameters values;
    values << static_cast<std::int64_t>(sequence) << owner << static_cast<std::int64_t>(limit);
    const auto rows = connection.run_all_lengthy(
        // What is forgotten in between counts as a gap.
        {{"SELECT n.number, n.id, j.state, j.cancel_requested, greatest(j.revision, r.revision) FROM change_numbers AS "
          "n LEFT JOIN jobs AS j ON j.id = n.id LEFT JOIN runs AS r ON r.id = n.id WHERE n.number > $1 AND ($2 IS NULL "
          "OR n.owner = $2) ORDER BY n.number LIMIT $3",
          std::move(values)},
         {"SELECT lowest FROM change_feed"}});
    Changes changes;
    changes.gap = sequence > last || rows[1].empty() || static_cast<std::int64_t>(sequence) < rows[1].integer(0, 0);
    const PostgresRows& list = rows[0];
    bool queued = changes.gap;
    for (std::size_t row = 0; row < list.size(); ++row) {
      Changed changed;
      changed.sequence = static_cast<std::uint64_t>(list.integer(row, 0));
      changed.id = list.uuid(row, 1);
      if (!list.null(row, 2)) {
        changed.state = api::job_state(list.text(row, 2));
        if (!changed.state) throw StoreError("store: unknown state " + list.text(row, 2), false);
        changed.cancel_requested = changed.state == api::JobState::running && list.flag(row, 3);
        changed.revision = static_cast<std::uint64_t>(list.integer(row, 4));
      }
      queued = queued || changed.state == api::JobState::queued;
      changes.list.push_back(std::move(changed));
    }
    if (queued) ++queue_changes_;
    return changes;
  });
}

}  // namespace bahnwerk::server
