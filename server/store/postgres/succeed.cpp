/// PostgresStore: storing a plan. Setpoints are packed on the worker's thread and sent in pieces of a few megabytes,
/// each a transaction of its own. What a lost attempt has stored has another token than the result: nobody sees it.
#include "api/planned_job.hpp"
#include "core/base/progress.hpp"
#include "server/runtime/uuid7.hpp"
#include "server/store/codec.hpp"
#include "server/store/postgres/postgres_store.hpp"
#include "server/store/series_pieces.hpp"
#include "server/store/unpacking.hpp"

namespace bahnwerk::server {
namespace {

/// Fence: the attempt's row in `runs`, locked against its removal until the chunk is stored. A chunk whose answer was
/// lost is there already.
constexpr auto insert_chunk =
    "WITH run AS MATERIALIZED (SELECT id, token FROM runs WHERE id = $1 AND token = $2 FOR KEY SHARE) "
    "INSERT INTO chunks (id, token, first_row, row_count, data) SELECT id, token, $3, $4, $5 FROM run "
    "ON CONFLICT DO NOTHING";
constexpr auto insert_view =
    "WITH run AS MATERIALIZED (SELECT id, token FROM runs WHERE id = $1 AND token = $2 FOR KEY SHARE) "
    "INSERT INTO views (id, token, name, part, data) SELECT id, token, $3, $4, $5 FROM run "
    "ON CONFLICT (id, token, name, part) DO UPDATE SET data = excluded.data";

/// Fence: state and token in the job's row. $1 id, $2 token, $3 time, NULL: by the clock of the database, $4 revision,
/// $5 name of the call, $6 document, $7 columns, $8 rows, $9 rows per chunk, $10 cycle time, $11 version of the views,
/// $12 of the program.
constexpr auto succeed_statement =
    "WITH job AS (UPDATE jobs SET state = 'succeeded', fraction = 1, stage = 'done', message = '', "
    "finished_at = coalesce($3, clock_timestamp()), ended_by = $5, planned_by = $12, revision = "
    "greatest(jobs.revision, r.revision, $4) + 1, "
    "callback_due = CASE WHEN callback_receiver IS NOT NULL THEN coalesce($3, clock_timestamp()) END FROM runs AS r "
    "WHERE jobs.id = $1 AND "
    "state = 'running' AND jobs.token = $2 AND r.id = jobs.id RETURNING jobs.id, jobs.owner, jobs.token, started_at, "
    "finished_at), "
    "result AS (INSERT INTO results (id, token, document, columns, row_count, chunk_rows, cycle_time, views) "
    "SELECT id, token, $6, $7, $8, $9, $10, $11 FROM job), "
    "spent AS (INSERT INTO planning_use (owner, day, ms) SELECT owner, floor(extract(epoch FROM finished_at) / "
    "86400)::bigint, greatest(0, (extract(epoch FROM finished_at - started_at) * 1000)::bigint) FROM job WHERE owner "
    "IS NOT NULL ON CONFLICT (owner) DO UPDATE SET ms = CASE WHEN planning_use.day = excluded.day THEN "
    "planning_use.ms ELSE 0 END + excluded.ms, day = excluded.day), "
    "told AS (INSERT INTO changes (id, owner) SELECT id, owner FROM job), "
    "counted AS (INSERT INTO count_deltas (state, owner, jobs) SELECT s.state, coalesce(job.owner, ''), s.jobs FROM "
    "job, (VALUES ('running', -1), ('succeeded', 1)) AS s (state, jobs)), "
    "run AS (DELETE FROM runs USING job WHERE runs.id = job.id) SELECT count(*) FROM job";

}  // namespace

void PostgresStore::store_piece(Statements& statements, const Attempt& attempt, const SeriesPiece& piece) const {
  for (const SeriesChunk& chunk : piece.chunks) {
    PostgresParameters values;
    values.uuid(attempt.id) << attempt.token << static_cast<std::int64_t>(chunk.first)
                            << static_cast<std::int64_t>(chunk.rows);
    statements.push_back({insert_chunk, std::move(values.bytes(chunk.packed))});
  }
  for (const api::ViewPart& part : piece.views) {
    PostgresParameters values;
    values.uuid(attempt.id) << attempt.token << part.name << static_cast<std::int64_t>(part.part);
    statements.push_back({insert_view, std::move(values.bytes(part.bytes))});
  }
}

bool PostgresStore::succeed(const Attempt& attempt, const api::PlannedJob& planned, std::int64_t now,
                            const SeenRevision& seen, Progress progress) {
  const SetpointSource* source = planned.setpoints.get();
  const std::string document = pack_text(api::result_text(planned, progress));
  const auto columns = source ? std::optional(series_columns(*source)) : std::nullopt;
  const auto running = [&](PostgresConnection& connection) {
    return !connection
                .run("SELECT 1 FROM runs WHERE id = $1 AND token = $2", PostgresParameters().uuid(attempt.id)
                                                                            << attempt.token)
                .empty();
  };
  // The attempt is over: by an earlier call, or lost, and then this one shows that its worker lives.
  const auto ended_before = [&] {
    forget(attempt);
    const bool stored = with_connection(true, [&](PostgresConnection& connection) {
      if (ended(connection, attempt, api::JobState::succeeded)) return true;
      take_back_losses(connection, {attempt});
      return false;
    });
    if (stored) publish({{.id = attempt.id, .state = api::JobState::succeeded}});
    return stored;
  };
  SeriesPiece piece;
  if (source) {
    std::size_t first = 0;  // an earlier call may have been cut off
    const bool held = reading([&](PostgresConnection& connection) {
      if (!running(connection)) return false;
      const auto rows =
          connection.run("SELECT coalesce(max(first_row + row_count), 0) FROM chunks WHERE id = $1 AND token = $2",
                         PostgresParameters().uuid(attempt.id) << attempt.token);
      first = static_cast<std::size_t>(rows.integer(0, 0));
      return true;
    });
    if (!held) return ended_before();
    SeriesPacker packer(planned, first, progress);
    for (;;) {
      bool last = false;
      piece = packer.next(last);
      if (last) break;  // the last piece is stored with the result
      const bool stored = with_connection(true, [&](PostgresConnection& connection) {
        Statements statements;
        store_piece(statements, attempt, piece);
        connection.run_all_lengthy(statements);
        return running(connection);
      });
      if (!stored) return ended_before();
    }
  }
  const std::string name = Uuid7().next(now);
  Statements statements;
  store_piece(statements, attempt, piece);
  PostgresParameters values;
  (values.uuid(attempt.id) << attempt.token).time(clock(now)) << static_cast<std::int64_t>(seen());
  values.uuid(name).bytes(document) << columns << static_cast<std::int64_t>(source ? source->count() : 0)
                                    << static_cast<std::int64_t>(series_chunk_rows)
                                    << (source ? source->cycle_time() : 0.0)
                                    << std::int64_t{source ? api::views_version : 0} << options_.planned_by;
  statements.push_back({succeed_statement, std::move(values)});
  const bool stored = with_connection(true, [&](PostgresConnection& connection) {
    return connection.run_all_lengthy(statements).back().integer(0, 0) == 1;
  });
  if (!stored) return ended_before();
  forget(attempt);
  publish({{.id = attempt.id, .state = api::JobState::succeeded}});
  return true;
}

std::optional<std::string> PostgresStore::read_view(const SeriesInfo& series, std::string_view name, std::size_t part) {
  return reading([&](PostgresConnection& connection) -> std::optional<std::string> {
    PostgresParameters values;
    values.uuid(series.id) << series.key << name << static_cast<std::int64_t>(part);
    const auto rows =
        connection.run("SELECT data FROM views WHERE id = $1 AND token = $2 AND name = $3 AND part = $4", values);
    if (rows.empty()) return std::nullopt;
    return unpacking([&] { return unpack_text(rows.bytes(0, 0)); });
  });
}

void PostgresStore::put_views(const SeriesInfo& series, const std::vector<api::ViewPart>& parts, bool last) {
  std::vector<api::ViewPart> all;
  Compressor compressor;
  for (const api::ViewPart& part : parts) all.push_back(packed(part, compressor));
  Statements statements{{"SELECT id FROM results WHERE id = $1 AND token = $2 FOR UPDATE",
                         PostgresParameters().uuid(series.id) << series.key}};
  for (const api::ViewPart& part : all) {
    PostgresParameters values;
    values.uuid(series.id) << series.key << part.name << static_cast<std::int64_t>(part.part);
    statements.push_back(
        {"INSERT INTO views (id, token, name, part, data) SELECT id, token, $3, $4, $5 FROM results "
         "WHERE id = $1 AND token = $2 ON CONFLICT (id, token, name, part) DO UPDATE SET data = "
         "excluded.data",
         std::move(values.bytes(part.bytes))});
  }
  if (last)
    statements.push_back({"UPDATE results SET views = $3 WHERE id = $1 AND token = $2",
                          PostgresParameters().uuid(series.id) << series.key << std::int64_t{api::views_version}});
  const auto rows =
      with_connection(true, [&](PostgresConnection& connection) { return connection.run_all_lengthy(statements); });
  if (rows[0].empty()) throw StoreError("the setpoints are gone: the job was deleted", false);
}

}  // namespace bahnwerk::server
