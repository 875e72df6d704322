#include "server/store/sqlite/views.hpp"

#include "server/store/codec.hpp"
#include "server/store/series_pieces.hpp"
#include "server/store/sqlite/reader.hpp"
#include "server/store/unpacking.hpp"

namespace bahnwerk::server {

void insert_views(SqliteConnection& connection, std::int64_t seq, const std::vector<api::ViewPart>& parts) {
  for (const api::ViewPart& part : parts) {
    Query row = connection.query("INSERT OR REPLACE INTO views (seq, name, part, data) VALUES (?, ?, ?, ?)");
    row << seq << part.name << static_cast<std::int64_t>(part.part);
    row.blob(part.bytes).run();
  }
}

std::optional<std::string> SqliteStore::read_view(const SeriesInfo& series, std::string_view name, std::size_t part) {
  Reader reader(*this);
  Query row = reader.query("SELECT data FROM views WHERE seq = ? AND name = ? AND part = ?");
  row << series.key << name << static_cast<std::int64_t>(part);
  if (!row.step()) return std::nullopt;
  return unpacking([&] { return unpack_text(row.bytes(0)); });
}

void SqliteStore::put_views(const SeriesInfo& series, const std::vector<api::ViewPart>& parts, bool last) {
  std::vector<api::ViewPart> all;
  Writer::Bytes bytes = Writer::row;
  Compressor compressor;
  for (const api::ViewPart& part : parts) {
    all.push_back(packed(part, compressor));
    bytes += all.back().bytes.size() + view_row;
  }
  const bool stored = write_flag(
      [&](SqliteConnection& connection) {
        Query job = connection.query("SELECT 1 FROM results WHERE seq = ?");
        job << series.key;
        if (!job.step()) return false;
        insert_views(connection, series.key, all);
        if (last)
          (connection.query("UPDATE results SET views = ? WHERE seq = ?")
           << std::int64_t{api::views_version} << series.key)
              .run();
        return true;
      },
      bytes);
  if (!stored) throw StoreError("the setpoints are gone: the job was deleted", false);
}

}  // namespace bahnwerk::server
