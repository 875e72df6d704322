/// SqliteStore: a worker's side, from claim to end. Every change is conditional on the attempt that makes it.
#include <nlohmann/json.hpp>

#include "api/problem.hpp"
#include "server/store/codec.hpp"
#include "server/store/sqlite/packed_series.hpp"
#include "server/store/sqlite/rows.hpp"
#include "server/store/sqlite/sqlite_store.hpp"

namespace bahnwerk::server {

std::optional<api::Job> SqliteStore::claim(std::int64_t now) {
  std::optional<api::Job> job;
  std::string packed;
  bool whole = true;
  writer_.run([&](Connection& connection) {
    job.reset();
    Query next = connection.query("SELECT seq FROM jobs WHERE state = 'queued' ORDER BY priority DESC, seq LIMIT 1");
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
  });
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
      [done = std::move(done)](const std::exception_ptr&) { done(); });
}

bool SqliteStore::end(const std::string& id, int attempt, const Ending& ending) {
  return write_flag([&](Connection& connection) {
    return (connection.query("UPDATE jobs SET state = ?, error = ?, finished_at = ?, revision = max(revision, ?) + 1 "
                             "WHERE id = ? AND state = 'running' AND attempt = ?")
            << api::to_string(ending.state) << ending.error << ending.now << static_cast<std::int64_t>(ending.revision)
            << id << std::int64_t{attempt})
               .run() == 1;
  });
}

bool SqliteStore::requeue(const std::string& id, int attempt, std::int64_t now, std::uint64_t revision) {
  const std::string error = api::Problem("cancelled", "The job was cancelled.").document("/v1/jobs/" + id).dump();
  return write_flag([&](Connection& connection) {
    const int cancelled =
        (connection.query(
             "UPDATE jobs SET state = 'cancelled', error = ?, finished_at = ?, revision = max(revision, ?) + 1 "
             "WHERE id = ? AND state = 'running' AND attempt = ? AND cancel_requested = 1")
         << error << now << static_cast<std::int64_t>(revision) << id << std::int64_t{attempt})
            .run();
    if (cancelled == 1) return true;
    return (connection.query(
                "UPDATE jobs SET state = 'queued', attempt = attempt - 1, started_at = NULL, fraction = 0, "
                "stage = '', message = '', revision = max(revision, ?) + 1 "
                "WHERE id = ? AND state = 'running' AND attempt = ?")
            << static_cast<std::int64_t>(revision) << id << std::int64_t{attempt})
               .run() == 1;
  });
}

bool SqliteStore::succeed(const std::string& id, int attempt, const api::PlannedJob& planned, std::int64_t now,
                          std::uint64_t revision) {
  // Everything that can be prepared is prepared here, on the worker's thread.
  const SetpointSource* source = planned.setpoints.get();
  const std::string document = pack_text(planned.result.dump());
  const PackedSeries series(source);
  std::optional<std::string> columns;
  if (source) {
    nlohmann::json list = nlohmann::json::array();
    for (const Column& column : source->columns()) list.push_back({{"name", column.name}, {"unit", column.unit}});
    columns = list.dump();
  }
  return write_flag([&](Connection& connection) {
    Query update = connection.query(
        "UPDATE jobs SET state = 'succeeded', fraction = 1, stage = 'done', message = '', finished_at = ?, "
        "revision = max(revision, ?) + 1 WHERE id = ? AND state = 'running' AND attempt = ? RETURNING seq");
    update << now << static_cast<std::int64_t>(revision) << id << std::int64_t{attempt};
    if (!update.step()) return false;
    const std::int64_t seq = update.integer(0);
    update.step();
    Query result = connection.query(
        "INSERT INTO results (seq, document, columns, row_count, chunk_rows, cycle_time) VALUES (?, ?, ?, ?, ?, ?)");
    (result << seq).blob(document);
    result << columns << static_cast<std::int64_t>(source ? source->count() : 0)
           << static_cast<std::int64_t>(PackedSeries::chunk_rows) << (source ? source->cycle_time() : 0.0);
    result.run();
    series.each([&](std::size_t first, std::size_t rows, const std::string& packed) {
      Query chunk = connection.query("INSERT INTO chunks (seq, first_row, row_count, data) VALUES (?, ?, ?, ?)");
      chunk << seq << static_cast<std::int64_t>(first) << static_cast<std::int64_t>(rows);
      chunk.blob(packed).run();
    });
    return true;
  });
}

}  // namespace bahnwerk::server
