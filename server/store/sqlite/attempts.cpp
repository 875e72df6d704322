/// SqliteStore: the calls of workers, from claim to end. Every change is conditional on the token of the
/// attempt that makes it: one transaction of the one writer reads and writes it.
#include "server/store/codec.hpp"
#include "server/store/sqlite/leftovers.hpp"
#include "server/store/sqlite/rows.hpp"
#include "server/store/sqlite/sqlite_store.hpp"

namespace bahnwerk::server {

std::optional<api::Job> SqliteStore::claim(const Lease& lease) {
  std::optional<api::Job> job;
  std::string packed;
  std::int64_t form = document_checked;
  std::optional<std::int64_t> leftovers;  // rows of an earlier attempt have to go before the next one stores its own
  writer_.run(
      [&](SqliteConnection& connection) {
        job.reset();
        leftovers.reset();
        lose(connection, lease.now, lease.now, max_expired_at_once);
        Query next = connection.query(
            "SELECT seq, suspect FROM jobs INDEXED BY jobs_queue WHERE state = 'queued' AND needs <= ? "
            "ORDER BY priority DESC, turn, seq LIMIT 1");
        next << std::int64_t{options_.engine};
        if (!next.step()) return;
        const std::int64_t seq = next.integer(0);
        // A suspect waits until nothing else runs in this process, and the others until it has ended.
        Query running = connection.query("SELECT max(suspect) FROM jobs WHERE state = 'running' AND worker = ?");
        running << lease.worker;
        running.step();
        if (!running.null(0) && (next.integer(1) != 0 || running.integer(0) != 0)) return;
        if (has_leftovers(connection, seq)) {
          leftovers = seq;
          return;
        }
        static const std::string sql =
            std::string(
                "UPDATE jobs SET state = 'running', attempt = attempt + 1, token = token + 1, started_at = ?, "
                "worker = ?, lease_until = ?, revision = revision + 1, changed = ? "
                "WHERE seq = ? RETURNING ") +
            job_columns;
        Query claimed = connection.query(sql);
        const std::int64_t change = changes_.next();
        claimed << lease.now << lease.worker << lease.until << change << seq;
        claimed.step();
        job = job_from_row(claimed);
        claimed.step();
        Query spec = connection.query("SELECT spec, whole FROM specs WHERE seq = ?");
        spec << seq;
        if (!spec.step()) throw StoreError("store: a job without its spec", false);
        packed = spec.bytes(0);
        form = spec.integer(1);
        changes_.note(change, job->id, api::JobState::running);
      },
      Writer::row);
  if (leftovers) {
    while (free_piece(*leftovers)) {
    }
    return claim(lease);
  }
  if (!job) return job;
  job->request.document = unpack_document(job->request.kind, packed, form != spec_alone);
  job->request.checked = form != document_unchecked;
  return job;
}

std::vector<Held> SqliteStore::heartbeat(const Lease& lease, const std::vector<Progressed>& attempts) {
  std::vector<Held> held;
  if (attempts.empty()) return held;
  writer_.run(
      [&](SqliteConnection& connection) {
        held.clear();
        for (const Progressed& p : attempts) {
          Query update = connection.query(
              "UPDATE jobs SET lease_until = ?1, fraction = iif(?2 >= revision, ?3, fraction), "
              "stage = iif(?2 >= revision, ?4, stage), message = iif(?2 >= revision, ?5, message), "
              "revision = max(revision, ?2) WHERE id = ?6 AND state = 'running' AND token = ?7 AND worker = ?8 "
              "RETURNING revision, cancel_requested");
          update << lease.until << static_cast<std::int64_t>(p.revision) << p.fraction << p.stage << p.message
                 << p.attempt.id << p.attempt.token << lease.worker;
          if (update.step())
            held.push_back({p.attempt, static_cast<std::uint64_t>(update.integer(0)), update.integer(1) != 0});
          else
            take_back_loss(connection, p.attempt);
        }
      },
      Writer::row);
  return held;
}

bool SqliteStore::end(const Attempt& attempt, const Ending& ending) {
  const std::string document = ending.result.empty() ? std::string() : pack_text(ending.result);
  return write_flag(
      [&](SqliteConnection& connection) {
        if (!leave(connection, {.id = attempt.id,
                                .from = api::JobState::running,
                                .token = attempt.token,
                                .to = {ending.state, ending.error},
                                .now = ending.now,
                                .seen = ending.revision,
                                .planned_by = options_.planned_by})) {
          if (ended(connection, attempt, ending.state)) return true;
          take_back_loss(connection, attempt);
          return false;
        }
        if (!document.empty()) {
          Query result = connection.query("INSERT INTO results (seq, document) SELECT seq, ? FROM jobs WHERE id = ?");
          (result.blob(document) << attempt.id).run();
        }
        return true;
      },
      Writer::frees);
}

bool SqliteStore::requeue(const Attempt& attempt, std::int64_t now, std::uint64_t revision) {
  return write_flag(
      [&](SqliteConnection& connection) {
        Query asked = connection.query("SELECT cancel_requested FROM jobs WHERE id = ?");
        asked << attempt.id;
        const bool cancelled = asked.step() && asked.integer(0) != 0;
        const bool left = leave(connection, {.id = attempt.id,
                                             .from = api::JobState::running,
                                             .token = attempt.token,
                                             .to = after_requeue(attempt.id, cancelled),
                                             .now = now,
                                             .seen = revision,
                                             .not_made = 1});
        if (!left) take_back_loss(connection, attempt);
        return left;
      },
      Writer::frees);
}

bool SqliteStore::ended(SqliteConnection& connection, const Attempt& attempt, api::JobState state) {
  Query job = connection.query("SELECT 1 FROM jobs WHERE id = ? AND state = ? AND ended_by = ?");
  job << attempt.id << api::to_string(state) << attempt.token;
  return job.step();
}

/// A job that has ended stays as it is.
void SqliteStore::take_back_loss(SqliteConnection& connection, const Attempt& attempt) {
  (connection.query("UPDATE jobs SET losses = losses - 1, lost_tokens = (SELECT json_group_array(value) FROM "
                    "json_each(lost_tokens) WHERE value <> ?2) WHERE id = ?1 AND ?2 IN (SELECT value FROM "
                    "json_each(lost_tokens)) AND state IN ('queued', 'running')")
   << attempt.id << attempt.token)
      .run();
}

bool SqliteStore::leave(SqliteConnection& connection, const Step& step) {
  const std::int64_t change = changes_.next();
  const bool queued = step.to.state == api::JobState::queued;
  Query update = connection.query(
      queued ? "UPDATE jobs SET state = ?1, error = ?2, started_at = NULL, attempt = attempt - ?3, fraction = 0, "
               "stage = '', message = '', revision = max(revision, ?4) + ?5, changed = ?6 "
               "WHERE id = ?7 AND state = ?8 AND token = coalesce(?9, token)"
             : "UPDATE jobs SET state = ?1, error = ?2, finished_at = ?3, revision = max(revision, ?4) + ?5, "
               "changed = ?6, planned_by = ?10, ended_by = iif(?10 IS NULL, NULL, token) "
               "WHERE id = ?7 AND state = ?8 AND token = coalesce(?9, token)");
  update << api::to_string(step.to.state) << (queued ? std::nullopt : std::optional(step.to.error))
         << (queued ? step.not_made : step.now) << static_cast<std::int64_t>(step.seen) << step.leap << change
         << step.id << api::to_string(step.from) << step.token;
  if (!queued) update << step.planned_by;
  if (update.run() == 0) return false;
  if (step.from == api::JobState::running) leave_chunks(connection, step.id);
  changes_.note(change, step.id, step.to.state);
  return true;
}

}  // namespace bahnwerk::server
