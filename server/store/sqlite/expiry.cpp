/// SqliteStore: jobs that end by the clock, by deadlines in the queue and leases of running jobs.
#include <algorithm>

#include "server/store/problems.hpp"
#include "server/store/sqlite/leftovers.hpp"
#include "server/store/sqlite/reader.hpp"
#include "server/store/sqlite/rows.hpp"

namespace bahnwerk::server {
namespace {

/// Clients may have seen revisions of a running job that were never stored; whoever takes it up again continues far
/// above them.
constexpr std::int64_t lost_leap = 1 << 20;

/// Selects the queued jobs with a deadline, the next one first.
constexpr auto deadlines =
    "SELECT id, deadline FROM jobs WHERE state = 'queued' AND deadline IS NOT NULL ORDER BY deadline LIMIT ?";

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
    const std::int64_t change = changes_.next();
    ids.push_back(orphan.id);
    leave_chunks(connection, orphan.id);
    if (!orphan.cancelled && orphan.losses < max_losses_alone) {
      (connection.query("UPDATE jobs SET state = 'queued', started_at = NULL, fraction = 0, stage = '', message = '', "
                        "suspect = 1, losses = ?, revision = revision + ?, changed = ? WHERE id = ?")
       << orphan.losses << lost_leap << change << orphan.id)
          .run();
      changes_.note(change, orphan.id, api::JobState::queued);
      continue;
    }
    const auto state = orphan.cancelled ? api::JobState::cancelled : api::JobState::failed;
    const std::string error = orphan.cancelled ? cancelled_error(orphan.id) : lost_error(orphan.id, orphan.losses);
    (connection.query("UPDATE jobs SET state = ?, error = ?, finished_at = ?, revision = revision + ?, changed = ? "
                      "WHERE id = ?")
     << api::to_string(state) << error << now << lost_leap << change << orphan.id)
        .run();
    changes_.note(change, orphan.id, state);
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
    if (next_leftovers(reader.connection())) expired.next = now;
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
    for (const std::string& id : expired.ids) {
      const std::int64_t change = changes_.next();
      (connection.query("UPDATE jobs SET state = 'failed', error = ?, finished_at = ?, revision = revision + 1, "
                        "changed = ? WHERE id = ? AND state = 'queued'")
       << deadline_error(id) << now << change << id)
          .run();
      changes_.note(change, id, api::JobState::failed);
    }
    expired.lost = lose(connection, now, now, max_expired_at_once);
    expired.next = earlier(expired.next, next_lease(connection));
    const auto leftovers = next_leftovers(connection);
    if (leftovers && (free_leftovers(connection, *leftovers) || next_leftovers(connection))) expired.next = now;
  });
  return expired;
}

}  // namespace bahnwerk::server
