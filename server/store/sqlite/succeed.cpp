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
#include "server/store/sqlite/views.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t chunk_rows = 4096;
constexpr std::size_t piece_bytes = 4 << 20;

struct Chunk {
  std::size_t first = 0, rows = 0;
  std::string packed;
};

/// What one transaction stores: chunks, and the parts of views that the rows so far have completed.
struct Piece {
  std::vector<Chunk> chunks;
  std::vector<api::ViewPart> views;

  Writer::Bytes size() const {
    Writer::Bytes bytes = Writer::row;
    for (const Chunk& chunk : chunks) bytes += chunk.packed.size();
    for (const api::ViewPart& part : views) bytes += part.bytes.size() + view_row;
    return bytes;
  }
};

/// Reads a series once, and makes chunks and views of it.
class Packer {
 public:
  /// Rows before `first` are stored already; the views need them again.
  Packer(const api::PlannedJob& planned, std::size_t first, Progress& progress)
      : source_(*planned.setpoints),
        stored_(first),
        progress_(progress),
        views_({source_.columns(), source_.count(), source_.cycle_time(), planned.view_facts},
               [this](api::ViewPart part) { piece_.views.push_back(packed(std::move(part), compressor_)); }) {}

  /// Returns the next piece; `last` becomes true with the last one.
  Piece next(bool& last) {
    const std::size_t columns = source_.columns().size();
    piece_ = {};
    for (std::size_t bytes = 0; row_ < source_.count() && bytes < piece_bytes;) {
      // Rows that are only read take a few ms per 16 chunks.
      if (row_ >= stored_ || row_ % (16 * chunk_rows) == 0) progress_.report("storing", 1);
      const std::size_t rows = std::min(chunk_rows, source_.count() - row_);
      values_.resize(rows * columns);
      source_.read(row_, rows, values_.data());
      views_.add(rows, values_.data());
      if (row_ >= stored_) {
        piece_.chunks.push_back({row_, rows, compressor_.rows(values_.data(), rows, columns)});
        bytes += piece_.chunks.back().packed.size();
      }
      row_ += rows;
    }
    last = row_ == source_.count();
    if (last) views_.finish();
    return std::move(piece_);
  }

 private:
  const SetpointSource& source_;
  std::size_t stored_;
  Progress& progress_;
  Compressor compressor_;
  Piece piece_;
  api::Views views_;
  std::size_t row_ = 0;
  std::vector<double> values_;
};

void insert_piece(SqliteConnection& connection, std::int64_t seq, const Piece& piece) {
  insert_views(connection, seq, piece.views);
  for (const Chunk& chunk : piece.chunks) {
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

bool SqliteStore::succeed(const Attempt& attempt, const api::PlannedJob& planned, std::int64_t now,
                          std::uint64_t revision, Progress& progress) {
  const std::string& id = attempt.id;
  const SetpointSource* source = planned.setpoints.get();
  const std::string document = pack_text(api::result_text(planned, progress));
  const auto columns = source ? std::optional(column_list(*source)) : std::nullopt;
  const auto still_running = [&](SqliteConnection& connection) -> std::optional<std::int64_t> {
    Query job = connection.query("SELECT seq FROM jobs WHERE id = ? AND state = 'running' AND token = ?");
    job << id << attempt.token;
    return job.step() ? std::optional(job.integer(0)) : std::nullopt;
  };

  Piece piece;
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
    Packer packer(planned, first, progress);
    for (;;) {
      bool last = false;
      piece = packer.next(last);
      if (last) break;  // the last piece is stored with the result
      const bool stored = write_flag(
          [&](SqliteConnection& connection) {
            const auto seq = still_running(connection);
            if (seq) insert_piece(connection, *seq, piece);
            return seq.has_value();
          },
          piece.size());
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
            "INSERT INTO results (seq, document, columns, row_count, chunk_rows, cycle_time, views) "
            "VALUES (?, ?, ?, ?, ?, ?, ?)");
        (result << *seq).blob(document);
        result << columns << static_cast<std::int64_t>(source ? source->count() : 0)
               << static_cast<std::int64_t>(chunk_rows) << (source ? source->cycle_time() : 0.0)
               << std::int64_t{source ? api::views_version : 0};
        result.run();
        insert_piece(connection, *seq, piece);
        changes_.note(change, id, api::JobState::succeeded);
        return true;
      },
      document.size() + piece.size());
}

}  // namespace bahnwerk::server
