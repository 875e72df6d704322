/// SqliteStore: the calls that only read.
#include <algorithm>
#include <filesystem>

#include "server/store/codec.hpp"
#include "server/store/series_pieces.hpp"
#include "server/store/sqlite/reader.hpp"
#include "server/store/sqlite/rows.hpp"
#include "server/store/unpacking.hpp"

namespace bahnwerk::server {
std::optional<api::Job> SqliteStore::get(const std::string& id, bool with_document) {
  static const std::string light = std::string("SELECT ") + job_columns + " FROM jobs WHERE id = ?";
  static const std::string whole = std::string("SELECT ") + job_columns +
                                   ", spec, whole, callback_secret FROM jobs JOIN specs USING (seq) WHERE id = ?";
  const std::uint64_t commits =
      writer_.commits();  // number before the look, so that a change during it counts as later
  Reader reader(*this);
  Query row = reader.query(with_document ? whole : light);
  row << id;
  if (!row.step()) return std::nullopt;
  api::Job job = job_from_row(row);
  if (!with_document) {
    cache_.put(commits, job);
    return job;
  }
  job.request.document = unpacking([&] {
    return unpack_document(job.request.kind, row.bytes(job_seq_column + 1),
                           row.integer(job_seq_column + 2) != spec_alone);
  });
  if (job.request.callback) job.request.callback->secret = row.optional_text(job_seq_column + 3);
  return job;
}

std::optional<api::Job> SqliteStore::at_hand(const std::string& id) { return cache_.find(writer_.commits(), id); }

Changes SqliteStore::changes_since(std::uint64_t sequence, std::size_t limit, const std::optional<std::string>& owner) {
  Reader reader(*this);
  return server::changes_since(reader.connection(), sequence, limit, owner);
}

std::uint64_t SqliteStore::last_change() {
  Reader reader(*this);
  return server::last_change(reader.connection());
}

StoreStatus SqliteStore::status() {
  StoreStatus status;
  const auto size = [](const std::string& path) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path, error);
    return error ? 0.0 : static_cast<double>(bytes);
  };
  status.bytes = size(options_.path);
  status.log_bytes = size(options_.path + "-wal");
  status.free_bytes = static_cast<double>(reserve_.free_space());
  Reader reader(*this);
  Query oldest = reader.query(
      "SELECT min((SELECT created_at FROM jobs WHERE owner IS nullif(job_counts.owner, '') AND state = 'queued' "
      "ORDER BY id LIMIT 1)) FROM job_counts WHERE state = 'queued' AND jobs > 0");
  if (oldest.step()) status.oldest_queued = oldest.optional_integer(0);
  Query callbacks = reader.query("SELECT count(*) FROM jobs INDEXED BY jobs_callback WHERE callback_due IS NOT NULL");
  callbacks.step();
  status.callbacks = static_cast<std::size_t>(callbacks.integer(0));
  Query left = reader.query(
      "SELECT count(*) FROM jobs INDEXED BY jobs_needs WHERE state = 'queued' AND needs > 0 AND needs > ?");
  left << std::int64_t{options_.engine};
  left.step();
  status.beyond_engine = static_cast<std::size_t>(left.integer(0));
  return status;
}

void SqliteStore::ping() {
  if (writer_.full()) throw StoreError("no space left for the store", true);
  Reader reader(*this);
  reader.query("SELECT count(*) FROM (SELECT 1 FROM jobs LIMIT 1)").one_int();
}

bool SqliteStore::cancel_requested(const std::string& id) {
  Reader reader(*this);
  Query row = reader.query("SELECT cancel_requested FROM jobs WHERE id = ?");
  row << id;
  return row.step() && row.integer(0) != 0;
}

std::optional<SeriesInfo> SqliteStore::series(const std::string& id) {
  Reader reader(*this);
  Query row = reader.query(
      "SELECT seq, columns, row_count, chunk_rows, cycle_time, views FROM results JOIN jobs USING (seq) WHERE id = ?");
  row << id;
  if (!row.step() || row.null(1)) return std::nullopt;
  SeriesInfo info;
  info.id = id;
  info.key = row.integer(0);
  info.count = static_cast<std::size_t>(row.integer(2));
  info.chunk_rows = static_cast<std::size_t>(row.integer(3));
  info.cycle_time = row.number(4);
  info.views = static_cast<int>(row.integer(5));
  read_series_columns(row.text(1), info);
  return info;
}

void SqliteStore::read_chunk(const SeriesInfo& series, std::size_t first_row, std::vector<double>& out) {
  Reader reader(*this);
  Query row = reader.query("SELECT row_count, data FROM chunks WHERE seq = ? AND first_row = ?");
  row << series.key << static_cast<std::int64_t>(first_row);
  if (!row.step()) throw StoreError("the setpoints are gone: the job was deleted", false);
  unpacking([&] { unpack_rows(row.bytes(1), series.columns.size(), out); });
  const std::size_t rows = std::min(series.chunk_rows, series.count - first_row);
  if (static_cast<std::size_t>(row.integer(0)) != rows || out.size() != rows * series.columns.size())
    throw StoreError("stored setpoints are damaged", false);
}

}  // namespace bahnwerk::server
