/// SqliteStore: storing a plan. Setpoints are packed on the worker's thread and written in pieces of a few megabytes,
/// each in a transaction of its own, so that other writers can proceed in between and the worker can be stopped. Rows
/// stored before the result are not visible; the end of the attempt removes them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/planned_job.hpp"
#include "core/base/progress.hpp"
#include "server/store/codec.hpp"
#include "server/store/sqlite/reader.hpp"
#include "server/store/sqlite/sqlite_store.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t chunk_rows = 4096;
constexpr std::size_t piece_bytes = 4 << 20;

struct Chunk {
  std::size_t first = 0, rows = 0;
  std::string packed;
};

/// Reads the chunks of one piece from row `first` on, and moves `first` behind them.
std::vector<Chunk> pack_piece(const SetpointSource& source, std::size_t& first, Progress& progress) {
  std::vector<Chunk> piece;
  std::vector<double> values;
  const std::size_t columns = source.columns().size();
  for (std::size_t bytes = 0; first < source.count() && bytes < piece_bytes;) {
    progress.report("storing", 1);
    const std::size_t rows = std::min(chunk_rows, source.count() - first);
    values.resize(rows * columns);
    source.read(first, rows, values.data());
    piece.push_back({first, rows, pack_rows(values.data(), rows, columns)});
    bytes += piece.back().packed.size();
    first += rows;
  }
  return piece;
}

Writer::Bytes size_of(const std::vector<Chunk>& piece) {
  Writer::Bytes bytes = Writer::row;
  for (const Chunk& chunk : piece) bytes += chunk.packed.size();
  return bytes;
}

void insert_chunks(SqliteConnection& connection, std::int64_t seq, const std::vector<Chunk>& piece) {
  for (const Chunk& chunk : piece) {
    Query row = connection.query("INSERT INTO chunks (seq, first_row, row_count, data) VALUES (?, ?, ?, ?)");
    row << seq << static_cast<std::int64_t>(chunk.first) << static_cast<std::int64_t>(chunk.rows);
    row.blob(chunk.packed).run();
  }
}

/// Returns the columns as an array, or as an object with the poses' frame if it is known and the independent variable
/// if it is not time.
std::string column_list(const SetpointSource& source) {
  nlohmann::json list = nlohmann::json::array();
  for (const Column& column : source.columns()) list.push_back({{"name", column.name}, {"unit", column.unit}});
  const auto frame = source.pose_frame();
  const Independent over = source.independent();
  if (!frame && over.time()) return list.dump();
  nlohmann::json out{{"columns", std::move(list)}};
  if (frame) out["origin"] = {frame->x, frame->y, frame->z}, out["angle"] = frame->angle;
  if (!over.time()) out["independent"] = {over.name, over.unit, over.step};
  return out.dump();
}

}  // namespace

bool SqliteStore::succeed(const std::string& id, int attempt, const api::PlannedJob& planned, std::int64_t now,
                          std::uint64_t revision, Progress& progress) {
  const SetpointSource* source = planned.setpoints.get();
  const std::string document = pack_text(api::result_text(planned, progress));
  const auto columns = source ? std::optional(column_list(*source)) : std::nullopt;
  const auto still_running = [&](SqliteConnection& connection) -> std::optional<std::int64_t> {
    Query job = connection.query("SELECT seq FROM jobs WHERE id = ? AND state = 'running' AND attempt = ?");
    job << id << std::int64_t{attempt};
    return job.step() ? std::optional(job.integer(0)) : std::nullopt;
  };

  std::vector<Chunk> piece;
  if (source) {
    std::size_t first = 0;
    {
      Reader reader(*this);  // an earlier call may have been cut off by a full disk
      Query stored = reader.query(
          "SELECT coalesce(max(first_row + row_count), 0) FROM chunks JOIN jobs USING (seq) "
          "WHERE id = ? AND state = 'running' AND attempt = ?");
      stored << id << std::int64_t{attempt};
      if (stored.step()) first = static_cast<std::size_t>(stored.integer(0));
    }
    for (;;) {
      piece = pack_piece(*source, first, progress);
      if (first == source->count()) break;  // the last piece is stored with the result
      const bool stored = write_flag(
          [&](SqliteConnection& connection) {
            const auto seq = still_running(connection);
            if (seq) insert_chunks(connection, *seq, piece);
            return seq.has_value();
          },
          size_of(piece));
      if (!stored) return false;
    }
  }
  return write_flag(
      [&](SqliteConnection& connection) {
        const auto seq = still_running(connection);
        if (!seq) return false;
        const std::int64_t change = changes_.next();
        (connection.query("UPDATE jobs SET state = 'succeeded', fraction = 1, stage = 'done', message = '', "
                          "finished_at = ?, revision = max(revision, ?) + 1, changed = ? WHERE seq = ?")
         << now << static_cast<std::int64_t>(revision) << change << *seq)
            .run();
        Query result = connection.query(
            "INSERT INTO results (seq, document, columns, row_count, chunk_rows, cycle_time) VALUES (?, ?, ?, ?, ?, "
            "?)");
        (result << *seq).blob(document);
        result << columns << static_cast<std::int64_t>(source ? source->count() : 0)
               << static_cast<std::int64_t>(chunk_rows) << (source ? source->cycle_time() : 0.0);
        result.run();
        insert_chunks(connection, *seq, piece);
        changes_.note(change, id, api::JobState::succeeded);
        return true;
      },
      document.size() + size_of(piece));
}

}  // namespace bahnwerk::server
