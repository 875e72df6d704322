/// SqliteStore: a worker's side, from claim to end. Every change is conditional on the attempt that makes it.
#include <nlohmann/json.hpp>

#include "api/problem.hpp"
#include "server/store/codec.hpp"
#include "server/store/sqlite/rows.hpp"
#include "server/store/sqlite/sqlite_store.hpp"

namespace bahnwerk::server {
namespace {

/// What an attempt stored of a series before it ended without a result.
void drop_chunks(Connection& connection, const std::string& id) {
  (connection.query("DELETE FROM chunks WHERE seq = (SELECT seq FROM jobs WHERE id = ?)") << id).run();
}

}  // namespace

std::optional<api::Job> SqliteStore::claim(std::int64_t now) {
  std::optional<api::Job> job;
  std::string packed;
  bool whole = true;
  writer_.run(
      [&](Connection& connection) {
        job.reset();
        Query next =
            connection.query("SELECT seq FROM jobs WHERE state = 'queued' ORDER BY priority DESC, seq LIMIT 1");
        if (!next.step()) return;
        const std::int64_t seq = next.integer(0);
        static const std::string sql = std::string(
                                           "UPDATE jobs SET state = 'running', attempt = attempt + 1, started_at = ?, "
                                           "revision = revision + 1 WHERE seq = ? RETURNING ") +
                                       job_columns;
        Query claimed = connection.query(sql);
        claimed << now << seq;
        claimed.step();
        job = job_from_row(claimed);
        claimed.step();
        Query spec = connection.query("SELECT spec, whole FROM specs WHERE seq = ?");
        spec << seq;
        if (!spec.step()) throw StoreError("store: a job without its spec", false);
        packed = spec.bytes(0);
        whole = spec.integer(1) != 0;
        (connection.query("DELETE FROM chunks WHERE seq = ?") << seq).run();  // of an attempt that was lost
      },
      Writer::row);
  if (job) job->request.document = unpack_document(job->request.kind, packed, whole);
  return job;
}

void SqliteStore::progress(Progressed progress, std::function<void()> done) {
  const auto p = std::make_shared<Progressed>(std::move(progress));
  writer_.post(
      [p](Connection& connection) {
        (connection.query("UPDATE jobs SET fraction = ?, stage = ?, message = ?, revision = max(revision, ?) "
                          "WHERE id = ? AND state = 'running' AND attempt = ?")
         << p->fraction << p->stage << p->message << static_cast<std::int64_t>(p->revision) << p->id
         << std::int64_t{p->attempt})
            .run();
      },
      // Progress is a courtesy: when it cannot be stored, the next one may.
      [done = std::move(done)](const std::exception_ptr&) { done(); }, Writer::row);
}

bool SqliteStore::end(const std::string& id, int attempt, const Ending& ending) {
  return write_flag(
      [&](Connection& connection) {
        const int ended =
            (connection.query("UPDATE jobs SET state = ?, error = ?, finished_at = ?, "
                              "revision = max(revision, ?) + 1 WHERE id = ? AND state = 'running' AND attempt = ?")
             << api::to_string(ending.state) << ending.error << ending.now << static_cast<std::int64_t>(ending.revision)
             << id << std::int64_t{attempt})
                .run();
        if (ended == 1) drop_chunks(connection, id);
        return ended == 1;
      },
      Writer::frees);
}

bool SqliteStore::requeue(const std::string& id, int attempt, std::int64_t now, std::uint64_t revision) {
  const std::string error = api::Problem("cancelled", "The job was cancelled.").document("/v1/jobs/" + id).dump();
  return write_flag(
      [&](Connection& connection) {
        int changed =
            (connection.query(
                 "UPDATE jobs SET state = 'cancelled', error = ?, finished_at = ?, revision = max(revision, ?) + 1 "
                 "WHERE id = ? AND state = 'running' AND attempt = ? AND cancel_requested = 1")
             << error << now << static_cast<std::int64_t>(revision) << id << std::int64_t{attempt})
                .run();
        if (changed == 0)
          changed = (connection.query("UPDATE jobs SET state = 'queued', attempt = attempt - 1, started_at = NULL, "
                                      "fraction = 0, stage = '', message = '', revision = max(revision, ?) + 1 "
                                      "WHERE id = ? AND state = 'running' AND attempt = ?")
                     << static_cast<std::int64_t>(revision) << id << std::int64_t{attempt})
                        .run();
        if (changed == 1) drop_chunks(connection, id);
        return changed == 1;
      },
      Writer::frees);
}

}  // namespace bahnwerk::server
