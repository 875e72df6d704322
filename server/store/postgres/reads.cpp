/// PostgresStore: the calls that only read. Each is one statement, and sees one moment.
#include <algorithm>
#include <limits>

#include "server/store/codec.hpp"
#include "server/store/postgres/job_rows.hpp"
#include "server/store/postgres/postgres_store.hpp"
#include "server/store/series_pieces.hpp"
#include "server/store/unpacking.hpp"

namespace bahnwerk::server {
namespace {

/// A standby may be behind the server that clients have asked before. What it says of a job that has not ended, or of
/// one that it does not know, may be older than what they have seen.
[[noreturn]] void refuse_running() { throw StoreReadOnly("the store can be read only: only what has ended is known"); }

}  // namespace

std::optional<api::Job> PostgresStore::get(const std::string& id, bool with_document) {
  static const std::string light = std::string("SELECT ")
                                       .append(postgres_job_columns)
                                       .append(" FROM jobs AS j LEFT JOIN runs AS r ON r.id = j.id WHERE j.id = $1");
  static const std::string whole =
      std::string("SELECT ")
          .append(postgres_job_columns)
          .append(
              ", s.document, j.callback_secret FROM jobs AS j LEFT JOIN runs AS r ON r.id = j.id "
              "JOIN specs AS s ON s.id = j.id WHERE j.id = $1");
  return reading([&](PostgresConnection& connection) -> std::optional<api::Job> {
    const bool behind = connection.read_only();
    const auto rows = connection.run(with_document ? whole : light, PostgresParameters().uuid(id));
    if (rows.empty()) {
      if (behind) refuse_running();
      return std::nullopt;
    }
    api::Job job = job_from(rows, 0);
    if (behind && !job.finished_at) refuse_running();
    if (!with_document) return job;
    job.request.document = unpacking([&] { return unpack_text(rows.bytes(0, postgres_job_column_count)); });
    if (job.request.callback) job.request.callback->secret = rows.optional_text(0, postgres_job_column_count + 1);
    return job;
  });
}

std::vector<Running> PostgresStore::running() {
  const auto rows = reading([](PostgresConnection& connection) {
    if (connection.read_only()) refuse_running();
    return connection.run(
        "SELECT r.id, greatest(j.revision, r.revision) FROM runs AS r JOIN jobs AS j ON j.id = r.id ORDER BY r.id");
  });
  std::vector<Running> running;
  for (std::size_t row = 0; row < rows.size(); ++row)
    running.push_back({rows.uuid(row, 0), static_cast<std::uint64_t>(rows.integer(row, 1))});
  return running;
}

/// Whoever may read what others have deleted: sessions with a snapshot or a transaction of their own, prepared
/// transactions, and standbys by their slots. The begin of others' transactions is hidden from a user who is no member
/// of pg_read_all_stats, the number is not. A VACUUM keeps nothing.
constexpr auto oldest_snapshot =
    "SELECT coalesce(max(transactions), 0)::bigint, coalesce(max(seconds), 0)::float8 FROM ("
    "SELECT greatest(age(backend_xmin), age(backend_xid)) AS transactions, "
    "extract(epoch FROM clock_timestamp() - xact_start) AS seconds FROM pg_stat_activity "
    "WHERE (backend_xmin IS NOT NULL OR backend_xid IS NOT NULL) AND pid <> pg_backend_pid() AND "
    "(datname = current_database() OR datname IS NULL) AND backend_type IS DISTINCT FROM 'autovacuum worker' "
    "UNION ALL SELECT age(transaction), extract(epoch FROM clock_timestamp() - prepared) FROM pg_prepared_xacts "
    "WHERE database = current_database() "
    "UNION ALL SELECT age(xmin), NULL FROM pg_replication_slots WHERE xmin IS NOT NULL) AS snapshots";

StoreStatus PostgresStore::status() {
  return reading([&](PostgresConnection& connection) {
    const auto rows = connection.run_all_lengthy(
        {{"SELECT pg_database_size(current_database()), (SELECT created_at FROM jobs WHERE state = 'queued' ORDER BY "
          "id LIMIT 1), (SELECT count(*) FROM jobs WHERE callback_due IS NOT NULL), "
          "(SELECT count(*) FROM jobs WHERE state = 'queued' AND needs > 0 AND needs > $1), "
          "(SELECT sum(pg_stat_get_dead_tuples(name::regclass))::bigint FROM unnest(ARRAY['jobs', 'runs', 'changes', "
          "'change_numbers', 'change_feed', 'count_deltas']) AS name)",
          PostgresParameters() << std::int64_t{options_.engine}},
         {oldest_snapshot}});
    StoreStatus status;
    status.bytes = static_cast<double>(rows[0].integer(0, 0));
    status.free_bytes = std::numeric_limits<double>::infinity();
    status.oldest_queued = rows[0].optional_time(0, 1);
    status.callbacks = static_cast<std::size_t>(rows[0].integer(0, 2));
    status.beyond_engine = static_cast<std::size_t>(rows[0].integer(0, 3));
    status.dead_rows = static_cast<double>(rows[0].integer(0, 4));
    status.snapshot_transactions = static_cast<double>(rows[1].integer(0, 0));
    status.snapshot_seconds = rows[1].number(0, 1);
    return status;
  });
}

void PostgresStore::ping() {
  reading([&](PostgresConnection& connection) { return connection.run("SELECT 1 FROM jobs LIMIT 1"); });
}

bool PostgresStore::cancel_requested(const std::string& id) {
  return reading([&](PostgresConnection& connection) {
    const auto rows = connection.run("SELECT cancel_requested FROM jobs WHERE id = $1", PostgresParameters().uuid(id));
    return !rows.empty() && rows.flag(0, 0);
  });
}

std::map<api::JobState, std::size_t> PostgresStore::counts(const std::optional<std::string>& owner) {
  std::map<api::JobState, std::size_t> counts;
  for (const auto state : {api::JobState::queued, api::JobState::running, api::JobState::succeeded,
                           api::JobState::failed, api::JobState::cancelled})
    counts[state] = 0;
  const auto rows = reading([&](PostgresConnection& connection) {
    return connection.run(
        "SELECT state, sum(jobs)::bigint FROM count_deltas WHERE $1 IS NULL OR owner = $1 GROUP BY "
        "state",
        PostgresParameters() << owner);
  });
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (const auto state = api::job_state(rows.text(row, 0)))
      counts[*state] = static_cast<std::size_t>(std::max<std::int64_t>(0, rows.integer(row, 1)));
  return counts;
}

std::vector<std::string> PostgresStore::queue(std::size_t limit) {
  const auto rows = reading([&](PostgresConnection& connection) {
    return connection.run("SELECT id FROM jobs WHERE state = 'queued' ORDER BY rank, turn, id LIMIT $1",
                          PostgresParameters() << static_cast<std::int64_t>(limit));
  });
  std::vector<std::string> ids;
  for (std::size_t row = 0; row < rows.size(); ++row) ids.push_back(rows.uuid(row, 0));
  return ids;
}

PackedPart PostgresStore::part_of(std::string_view select, const std::string& id) {
  return [this, select, id](std::size_t offset, std::size_t bytes) {
    return reading([&](PostgresConnection& connection) {
      PostgresParameters values;
      values.uuid(id) << static_cast<std::int64_t>(offset + 1) << static_cast<std::int64_t>(bytes);
      const auto rows = connection.run_lengthy(select, values);
      if (rows.empty()) throw StoreError("the text is gone: the job was deleted", false);
      return rows.text(0, 0);
    });
  };
}

std::unique_ptr<StoredText> PostgresStore::open_document(const std::string& id) {
  const auto rows = reading([&](PostgresConnection& connection) {
    return connection.run("SELECT length(document) FROM specs WHERE id = $1", PostgresParameters().uuid(id));
  });
  if (rows.empty()) return nullptr;
  return open_packed_text(static_cast<std::size_t>(rows.integer(0, 0)),
                          part_of("SELECT substring(document FROM $2::int FOR $3::int) FROM specs WHERE id = $1", id));
}

std::unique_ptr<StoredText> PostgresStore::open_result(const std::string& id) {
  const auto rows = reading([&](PostgresConnection& connection) {
    return connection.run("SELECT length(document) FROM results WHERE id = $1", PostgresParameters().uuid(id));
  });
  if (rows.empty()) return nullptr;
  return open_packed_text(
      static_cast<std::size_t>(rows.integer(0, 0)),
      part_of("SELECT substring(document FROM $2::int FOR $3::int) FROM results WHERE id = $1", id));
}

std::optional<SeriesInfo> PostgresStore::series(const std::string& id) {
  const auto rows = reading([&](PostgresConnection& connection) {
    return connection.run("SELECT token, columns, row_count, chunk_rows, cycle_time, views FROM results WHERE id = $1",
                          PostgresParameters().uuid(id));
  });
  if (rows.empty() || rows.null(0, 1)) return std::nullopt;
  SeriesInfo info;
  info.id = id;
  info.key = rows.integer(0, 0);
  info.count = static_cast<std::size_t>(rows.integer(0, 2));
  info.chunk_rows = static_cast<std::size_t>(rows.integer(0, 3));
  info.cycle_time = rows.number(0, 4);
  info.views = static_cast<int>(rows.integer(0, 5));
  read_series_columns(rows.text(0, 1), info);
  return info;
}

void PostgresStore::read_chunk(const SeriesInfo& series, std::size_t first_row, std::vector<double>& out) {
  const auto rows = reading([&](PostgresConnection& connection) {
    PostgresParameters values;
    values.uuid(series.id) << series.key << static_cast<std::int64_t>(first_row);
    return connection.run_lengthy("SELECT row_count, data FROM chunks WHERE id = $1 AND token = $2 AND first_row = $3",
                                  values);
  });
  if (rows.empty()) throw StoreError("the setpoints are gone: the job was deleted", false);
  unpacking([&] { unpack_rows(rows.bytes(0, 1), series.columns.size(), out); });
  const std::size_t expected = std::min(series.chunk_rows, series.count - first_row);
  if (static_cast<std::size_t>(rows.integer(0, 0)) != expected || out.size() != expected * series.columns.size())
    throw StoreError("stored setpoints are damaged", false);
}

}  // namespace bahnwerk::server
