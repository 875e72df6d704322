/// SqliteStore: storing a plan. Setpoints are packed on the worker's thread and written in pieces of a few megabytes,
/// each in a transaction of its own, so that other writers can proceed in between and the worker can be stopped. Rows
/// stored before the result are not visible; the end of the attempt removes them.
#include "api/planned_job.hpp"
#include "core/base/progress.hpp"
#include "server/store/codec.hpp"
#include "server/store/series_pieces.hpp"
#include "server/store/sqlite/reader.hpp"
#include "server/store/sqlite/sqlite_store.hpp"
#include "server/store/sqlite/views.hpp"

namespace bahnwerk::server {
namespace {

Writer::Bytes size_of(const SeriesPiece& piece) {
  Writer::Bytes bytes = Writer::row;
  for (const SeriesChunk& chunk : piece.chunks) bytes += chunk.packed.size();
  for (const api::ViewPart& part : piece.views) bytes += part.bytes.size() + view_row;
  return bytes;
}

void insert_piece(SqliteConnection& connection, std::int64_t seq, const SeriesPiece& piece) {
  insert_views(connection, seq, piece.views);
  for (const SeriesChunk& chunk : piece.chunks) {
    Query row = connection.query("INSERT INTO chunks (seq, first_row, row_count, data) VALUES (?, ?, ?, ?)");
    row << seq << static_cast<std::int64_t>(chunk.first) << static_cast<std::int64_t>(chunk.rows);
    row.blob(chunk.packed).run();
  }
}

}  // namespace

bool SqliteStore::succeed(const Attempt& attempt, const api::PlannedJob& planned, std::int64_t now,
                          const SeenRevision& seen, Progress progress) {
  const std::string& id = attempt.id;
  const SetpointSource* source = planned.setpoints.get();
  const std::string document = pack_text(api::result_text(planned, progress));
  const auto columns = source ? std::optional(series_columns(*source)) : std::nullopt;
  const auto still_running = [&](SqliteConnection& connection) -> std::optional<std::int64_t> {
    Query job = connection.query("SELECT seq FROM jobs WHERE id = ? AND state = 'running' AND token = ?");
    job << id << attempt.token;
    return job.step() ? std::optional(job.integer(0)) : std::nullopt;
  };

  // The attempt is over: by an earlier call, or lost, and then this one shows that its worker lives.
  const auto ended_before = [&](SqliteConnection& connection) {
    if (ended(connection, attempt, api::JobState::succeeded)) return true;
    take_back_loss(connection, attempt);
    return false;
  };

  SeriesPiece piece;
  if (source) {
    std::size_t first = 0;
    {
      Reader reader(*this);  // an earlier call may have been cut off by a full disk
      Query stored = reader.query(
          "SELECT coalesce(max(first_row + row_count), 0) FROM chunks JOIN jobs USING (seq) "
          "WHERE id = ? AND state = 'running' AND token = ?");
      stored << id << attempt.token;
      if (stored.step()) first = static_cast<std::size_t>(stored.integer(0));
    }
    SeriesPacker packer(planned, first, progress);
    for (;;) {
      bool last = false;
      piece = packer.next(last);
      if (last) break;  // the last piece is stored with the result
      bool before = false;
      const bool stored = write_flag(
          [&](SqliteConnection& connection) {
            const auto seq = still_running(connection);
            if (seq)
              insert_piece(connection, *seq, piece);
            else
              before = ended_before(connection);
            return seq.has_value();
          },
          size_of(piece));
      if (!stored) return before;
    }
  }
  const std::uint64_t revision = seen();
  return write_flag(
      [&](SqliteConnection& connection) {
        const auto seq = still_running(connection);
        if (!seq) return ended_before(connection);
        const std::int64_t change = changes_.next();
        (connection.query(
             "UPDATE jobs SET state = 'succeeded', fraction = 1, stage = 'done', message = '', "
             "finished_at = ?, revision = max(revision, ?) + 1, changed = ?, ended_by = token, planned_by = ? "
             "WHERE seq = ?")
         << now << static_cast<std::int64_t>(revision) << change << options_.planned_by << *seq)
            .run();
        Query result = connection.query(
            "INSERT INTO results (seq, document, columns, row_count, chunk_rows, cycle_time, views) "
            "VALUES (?, ?, ?, ?, ?, ?, ?)");
        (result << *seq).blob(document);
        result << columns << static_cast<std::int64_t>(source ? source->count() : 0)
               << static_cast<std::int64_t>(series_chunk_rows) << (source ? source->cycle_time() : 0.0)
               << std::int64_t{source ? api::views_version : 0};
        result.run();
        insert_piece(connection, *seq, piece);
        changes_.note(change, id, api::JobState::succeeded);
        return true;
      },
      document.size() + size_of(piece));
}

}  // namespace bahnwerk::server
