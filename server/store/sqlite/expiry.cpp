/// SqliteStore: jobs that end by the clock, by deadlines in the queue and leases of running jobs.
#include <algorithm>

#include "server/store/sqlite/leftovers.hpp"
#include "server/store/sqlite/reader.hpp"
#include "server/store/sqlite/rows.hpp"

namespace bahnwerk::server {
namespace {

/// Selects the queued jobs with a deadline, the next one first.
constexpr auto deadlines =
    "SELECT id, deadline FROM jobs WHERE state = 'queued' AND deadline IS NOT NULL ORDER BY deadline LIMIT ?";

constexpr std::size_t max_removed_at_once = 64;
constexpr std::int64_t page_size = 4096;
constexpr std::int64_t pages_at_once = 512;  ///< given back to the disk in one transaction

std::int64_t pragma(SqliteConnection& connection, const char* name) {
  Query row = connection.query(name);
  return row.step() ? row.integer(0) : 0;
}

std::optional<std::int64_t> earlier(std::optional<std::int64_t> a, std::optional<std::int64_t> b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

std::optional<std::int64_t> next_lease(SqliteConnection& connection) {
  Query lease = connection.query("SELECT min(lease_until) FROM jobs WHERE state = 'running'");
  lease.step();
  if (lease.null(0) || lease.integer(0) == Lease::forever) return std::nullopt;
  return lease.integer(0);
}

}  // namespace

std::int64_t SqliteStore::spare_pages(SqliteConnection& connection) const {
  constexpr std::int64_t incremental = 2;  // value of PRAGMA auto_vacuum
  if (pragma(connection, "PRAGMA auto_vacuum") != incremental) return 0;
  return std::max(std::int64_t{0},
                  pragma(connection, "PRAGMA freelist_count") - options_.retention.spare_bytes / page_size);
}

std::vector<std::string> SqliteStore::too_old(SqliteConnection& connection, std::int64_t now, std::size_t most) const {
  const Retention& keep = options_.retention;
  if (!keep.time && !keep.jobs && !keep.bytes) return {};
  std::int64_t more = 0;  // ended jobs beyond the limits of number and bytes, as far as is known
  if (keep.jobs) {
    more =
        pragma(connection, "SELECT coalesce(sum(jobs), 0) FROM job_counts WHERE state NOT IN ('queued', 'running')") -
        *keep.jobs;
  }
  if (keep.bytes) {
    const std::int64_t used = pragma(connection, "PRAGMA page_count") - pragma(connection, "PRAGMA freelist_count");
    if (used * page_size > *keep.bytes) more = std::max<std::int64_t>(more, 1);  // one: the next look measures again
  }
  std::vector<std::string> ids;
  Query rows = connection.query(
      "SELECT id, finished_at FROM jobs WHERE finished_at IS NOT NULL AND callback_due IS NULL "
      "ORDER BY finished_at LIMIT ?");
  rows << static_cast<std::int64_t>(most);
  while (rows.step()) {
    const bool late = keep.time && rows.integer(1) <= now - *keep.time;
    if (!late && static_cast<std::int64_t>(ids.size()) >= more) break;
    ids.push_back(rows.text(0));
  }
  return ids;
}

std::vector<std::string> SqliteStore::lose(SqliteConnection& connection, std::int64_t until, std::int64_t now,
                                           std::size_t most) {
  struct Orphan {
    std::string id;
    std::int64_t losses;  ///< attempts that were lost while nothing else ran, this one included
    bool cancelled;
  };
  std::vector<Orphan> orphans;
  {
    Query running = connection.query(
        "SELECT id, losses + ((SELECT count(*) FROM jobs AS other WHERE other.state = 'running' AND "
        "other.worker IS jobs.worker) = 1), cancel_requested FROM jobs WHERE state = 'running' AND lease_until <= ? "
        "LIMIT ?");
    running << until << static_cast<std::int64_t>(most);
    while (running.step()) orphans.push_back({running.text(0), running.integer(1), running.integer(2) != 0});
  }
  std::vector<std::string> ids;
  for (const Orphan& orphan : orphans) {
    ids.push_back(orphan.id);
    const Fate fate = after_loss(orphan.id, orphan.losses, orphan.cancelled);
    if (fate.state == api::JobState::queued)
      (connection.query("UPDATE jobs SET suspect = 1, lost_tokens = iif(?1 > losses, json_insert(coalesce(lost_tokens, "
                        "'[]'), '$[#]', token), lost_tokens), losses = ?1 WHERE id = ?2")
       << orphan.losses << orphan.id)
          .run();
    leave(connection, {.id = orphan.id, .from = api::JobState::running, .to = fate, .now = now, .leap = lost_leap});
  }
  return ids;
}

Expired SqliteStore::expire(std::int64_t now) {
  Expired expired;
  {
    Reader reader(*this);
    Query deadline = reader.query(deadlines);
    deadline << std::int64_t{1};
    if (deadline.step()) expired.next = deadline.integer(1);
    expired.next = earlier(expired.next, next_lease(reader.connection()));
    if (next_leftovers(reader.connection()) || spare_pages(reader.connection()) > 0 ||
        !too_old(reader.connection(), now, 1).empty())
      expired.next = now;
    if (!expired.next || *expired.next > now) return expired;
  }
  writer_.run([&](SqliteConnection& connection) {
    expired = {};
    {
      Query due = connection.query(deadlines);
      due << static_cast<std::int64_t>(max_expired_at_once + 1);
      while (due.step()) {
        if (due.integer(1) > now || expired.ids.size() == max_expired_at_once) {
          expired.next = due.integer(1);
          break;
        }
        expired.ids.push_back(due.text(0));
      }
    }
    for (const std::string& id : expired.ids)
      leave(connection, {.id = id, .from = api::JobState::queued, .to = after_deadline(id), .now = now});
    expired.lost = lose(connection, now, now, max_expired_at_once);
    expired.next = earlier(expired.next, next_lease(connection));
    const auto leftovers = next_leftovers(connection);
    if (leftovers) {
      free_leftovers(connection, *leftovers);
      expired.next = now;  // there may be more, and the retention looks when there are none
    }
    // The space that removed jobs took is known when nothing of them is left.
    if (!leftovers)
      for (const std::string& id : too_old(connection, now, max_removed_at_once))
        expired.removed += remove_one(connection, id).outcome == Removed::yes ? 1 : 0;
    if (expired.removed > 0) expired.next = now;
    if (const std::int64_t pages = spare_pages(connection); pages > 0 && expired.removed == 0) {
      const auto piece = std::to_string(std::min(pages, pages_at_once));
      connection.execute(("PRAGMA incremental_vacuum(" + piece + ")").c_str());
      if (pages > pages_at_once) expired.next = now;
    }
  });
  return expired;
}

}  // namespace bahnwerk::server
