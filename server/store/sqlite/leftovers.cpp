#include "server/store/sqlite/leftovers.hpp"

#include <string_view>
#include <vector>

#include "server/store/sqlite/connection.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::int64_t piece_bytes = 2 << 20;

/// Deletes rows that a query selects with their sizes, about 2 MB of them; returns whether there may be more.
bool free_piece(SqliteConnection& connection, std::int64_t seq, std::string_view select, std::string_view remove) {
  std::vector<std::int64_t> ids;
  std::int64_t bytes = 0;
  {
    Query rows = connection.query(select);
    rows << seq;
    while (bytes < piece_bytes && rows.step()) {
      ids.push_back(rows.integer(0));
      bytes += rows.integer(1);
    }
  }
  for (const std::int64_t id : ids) (connection.query(remove) << id).run();
  return bytes >= piece_bytes;
}

}  // namespace

void leave_chunks(SqliteConnection& connection, const std::string& id) {
  (connection.query("INSERT OR IGNORE INTO leftovers (seq) SELECT seq FROM jobs "
                    "WHERE id = ? AND (EXISTS (SELECT 1 FROM chunks WHERE chunks.seq = jobs.seq) OR "
                    "EXISTS (SELECT 1 FROM views WHERE views.seq = jobs.seq))")
   << id)
      .run();
}

bool has_leftovers(SqliteConnection& connection, std::int64_t seq) {
  Query row = connection.query("SELECT 1 FROM leftovers WHERE seq = ?");
  row << seq;
  return row.step();
}

std::optional<std::int64_t> next_leftovers(SqliteConnection& connection) {
  Query row = connection.query("SELECT seq FROM leftovers LIMIT 1");
  return row.step() ? std::optional(row.integer(0)) : std::nullopt;
}

bool free_leftovers(SqliteConnection& connection, std::int64_t seq) {
  if (free_piece(connection, seq, "SELECT rowid, length(data) FROM chunks WHERE seq = ? ORDER BY first_row",
                 "DELETE FROM chunks WHERE rowid = ?") ||
      free_piece(connection, seq, "SELECT rowid, length(data) FROM views WHERE seq = ?",
                 "DELETE FROM views WHERE rowid = ?"))
    return true;
  (connection.query("DELETE FROM leftovers WHERE seq = ?") << seq).run();
  return false;
}

}  // namespace bahnwerk::server
